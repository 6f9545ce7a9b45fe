#pragma once

#include <map>
#include <memory>
#include <string>

#include <urdf_model/model.h>

namespace seam {

/// A URDF as urdfdom reads it, and what urdfdom forgets: the order of the joints in the file.
struct UrdfDocument {
  std::shared_ptr<urdf::ModelInterface> model;
  std::map<std::string, std::size_t> joint_order;
};

/// @throws Error  the file cannot be read, is no XML, or urdfdom logs an error (even where it
/// returns a
///                model, it has then dropped a part of it)
UrdfDocument read_urdf(const std::string& path);

}  // namespace seam
