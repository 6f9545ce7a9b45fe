#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <seam/robot_model.hpp>

namespace seam {

/// A mesh file in figures.
struct MeshFigures {
  int triangles = 0;
  Eigen::AlignedBox3d box;  // [m]
  double volume = 0.0;      // [m³] that the triangles enclose; of the box, if they enclose none
  std::string unreadable;   // why; empty if it was read
};

/// Mesh files, each read once.
class MeshCatalogue {
 public:
  const MeshFigures& operator[](const std::string& path);
  const std::map<std::string, MeshFigures>& files() const { return files_; }

 private:
  std::map<std::string, MeshFigures> files_;
};

/// Mass and shape of a body as figures that can be held against each other.
struct BodyFigures {
  Eigen::Vector3d moments;   // [kg m²] principal, ascending
  Eigen::Vector3d gyration;  // [m] √(moment/mass)
  Eigen::AlignedBox3d box;   // [m] around its shapes in the body frame; empty if it has none
  double reach = 0.0;        // [m] from the centre of mass to the farthest corner of the box
  double density = 0.0;      // [kg/m³] mass over the volume of its shapes; 0 if it has none
};

/// Of the shapes that are seen and those that collide; the volume is that of the ones or the others, whichever is larger.
BodyFigures body_figures(const Body& body, MeshCatalogue& meshes);

}  // namespace seam
