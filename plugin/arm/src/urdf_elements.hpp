#pragma once

#include <string>
#include <vector>

#include <urdf_model/link.h>

#include "urdf_place.hpp"
#include <seam/error.hpp>
#include <seam/robot_model.hpp>

namespace seam {

constexpr double farthest = 1e9;  // [m or rad] beyond, dynamics overflows

/// The elements of a URDF as seam's own types. What cannot be simulated is refused, what is odd is warned of at its place.
Eigen::Isometry3d pose_from_urdf(const urdf::Pose& pose);
/// As it is given, but for moments that are 0 by rounding; whether it can be simulated is for the merged bodies to say.
Inertial inertial_from_urdf(const urdf::Inertial& inertial, const UrdfPlace& place);
Joint joint_from_urdf(const urdf::Joint& joint, const UrdfPlace& place);
/// Whether the link, or what is behind it, has mass.
bool has_mass(const urdf::Link& link);

/// Where mesh names are looked up.
struct MeshPlaces {
  std::string urdf;                       // path of the URDF
  std::vector<std::string> package_path;  // folders that hold packages, or are one
};
/// The shapes that it is seen as: none if its size is none, three of a capsule.
/// @throws MeshNotFound  among other Errors
std::vector<Geometry> visual_from_urdf(const urdf::Visual& visual, bool is_capsule,
                                       const MeshPlaces& places, const UrdfPlace& place);
/// The shape that it collides as: none if its size is none.
std::vector<Geometry> collision_from_urdf(const urdf::Collision& collision, bool is_capsule,
                                          const MeshPlaces& places, const UrdfPlace& place);

class MeshNotFound : public Error {
 public:
  using Error::Error;
};

/// Absolute path of the file that a URDF's mesh name means.
/// @throws MeshNotFound  no such file; lists the places where it was looked for
std::string mesh_path(const std::string& name, const MeshPlaces& places, const std::string& where);

}  // namespace seam
