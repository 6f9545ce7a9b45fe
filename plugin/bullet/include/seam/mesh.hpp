#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// A triangle mesh of one colour.
struct Mesh {
  Eigen::Matrix3Xf positions;                      // [m] 3 × V
  Eigen::Matrix3Xf normals;                        // unit, 3 × V
  Eigen::Matrix3Xi triangles;                      // indices, 3 × T, anticlockwise from outside
  Eigen::Vector4f colour{0.8F, 0.8F, 0.8F, 1.0F};  // RGBA 0…1
};

/// The meshes of a file that assimp reads (OBJ, STL, DAE, glTF, …), one per material: node
/// transforms and COLLADA's unit applied, triangulated, Z up (the up-axis of COLLADA and glTF is
/// turned). Normals are the file's, or made from its faces with creases above 35° kept sharp where it has
/// none, and from the faces around where it has some of length 0. Faces without area are left out.
/// @throws Error  the file cannot be read, holds no triangle, or holds a value that is not finite
std::vector<Mesh> load_mesh(const std::string& path);

}  // namespace seam
