#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <urdf_model/model.h>

namespace seam {

/// A URDF as urdfdom reads it, and what urdfdom forgets or does not know.
struct UrdfDocument {
  std::shared_ptr<urdf::ModelInterface> model;
  std::map<std::string, std::size_t> joint_order;  // in the file
  // Link, and number among its visuals or collisions, of the cylinders that are capsules.
  std::set<std::pair<std::string, std::size_t>> capsule_visuals, capsule_collisions;
  std::vector<std::string> warnings;  // what was changed for urdfdom to read it, a line each
};

/// Reads what can be: see mend_urdf for what is changed beforehand.
/// @throws Error  the file cannot be read, is no XML, or urdfdom logs an error (even where it
/// returns a
///                model, it has then dropped a part of it)
UrdfDocument read_urdf(const std::string& path);

}  // namespace seam
