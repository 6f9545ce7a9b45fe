#pragma once

#include <string>
#include <vector>

#include <urdf_model/link.h>

#include <seam/error.hpp>
#include <seam/robot_model.hpp>

namespace seam {

/// The elements of a URDF as seam's own types, checked. `where` opens the message of a refusal:
/// file, element and its name.
Eigen::Isometry3d pose_from_urdf(const urdf::Pose& pose);
Inertial inertial_from_urdf(const urdf::Inertial& inertial, const std::string& where);
Joint joint_from_urdf(const urdf::Joint& joint, const std::string& where);

/// Where mesh names are looked up.
struct MeshPlaces {
  std::string urdf;                       // path of the URDF
  std::vector<std::string> package_path;  // folders that hold packages, or are one
};
/// @throws MeshNotFound  among other Errors
Geometry visual_from_urdf(const urdf::Visual& visual, const MeshPlaces& places,
                          const std::string& where);
Geometry collision_from_urdf(const urdf::Collision& collision, const MeshPlaces& places,
                             const std::string& where);

class MeshNotFound : public Error {
 public:
  using Error::Error;
};

/// Absolute path of the file that a URDF's mesh name means.
/// @throws MeshNotFound  no such file; lists the places where it was looked for
std::string mesh_path(const std::string& name, const MeshPlaces& places, const std::string& where);

}  // namespace seam
