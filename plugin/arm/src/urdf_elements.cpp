#include "urdf_elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Eigenvalues>

#include "mend_urdf.hpp"
#include "text.hpp"
#include <seam/error.hpp>

namespace seam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unlimited = std::numeric_limits<double>::max();  // see unlimited_text
constexpr double rounded = 1e-6;                                  // of six digits
constexpr double least_mass = 1e-15;                              // [kg] less is none
constexpr double largest = 1e15;  // [kg, kg m²] beyond, dynamics overflows

Eigen::Vector3d vector_from_urdf(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

void require_at_most(double bound, double value, const std::string& name, const char* unit,
                     const UrdfPlace& place) {
  if (!(std::abs(value) <= bound))
    place.refuse(text(name, " ", value, " ", unit, ", must be at most ", bound, " in magnitude"));
}

Eigen::Matrix3d with_moments(const Eigen::Matrix3d& axes, const Eigen::Vector3d& moments) {
  const Eigen::Matrix3d inertia = axes * moments.asDiagonal() * axes.transpose();
  return 0.5 * (inertia + inertia.transpose());
}

/// Takes moments for 0 that are so but for rounding; warns of those that no body has.
void judge_moments(Eigen::Matrix3d& inertia, double mass, const UrdfPlace& place) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia);
  const Eigen::Vector3d& moments = principal.eigenvalues();
  const double size = moments.cwiseAbs().maxCoeff();
  const double zero = 1e-12 * (size + std::abs(mass));  // gyrates by less than 1 µm
  const std::string found = text("inertia has the principal moments ", moments[0], ", ", moments[1],
                                 ", ", moments[2], " kg m^2, ");
  require_at_most(largest, size, "moment of inertia", "kg m^2", place);
  if (moments[0] < -std::max(rounded * size, zero)) {
    place.warn(found + "must all be > 0: counted as it is, with what it is fixed to");
  } else if (moments[0] <= zero) {
    place.warn(found + "must all be > 0: taken for 0 where they are 0 but for rounding");
    inertia = with_moments(principal.eigenvectors(), (moments.array() > zero).select(moments, 0.0));
  } else if (moments[2] > (1.0 + rounded) * (moments[0] + moments[1])) {
    const double excess = 100.0 * (moments[2] / (moments[0] + moments[1]) - 1.0);
    place.warn(found + text("the largest exceeds the sum of the others by ", excess,
                            " %, which no body's does: used as it is"));
  }
}

double limit_or_none(double value, const char* name, const char* unit, const UrdfPlace& place) {
  if (value < 0.0)
    place.warn(text(name, " limit ", value, " ", unit, ", must be >= 0: taken for none"));
  return value < 0.0 || value == unlimited ? infinity : value;
}

void set_position_limits(Joint& joint, const urdf::JointLimits& limits, const UrdfPlace& place) {
  const char* const unit = joint.type == Joint::Type::prismatic ? "m" : "rad";
  joint.lower = limits.lower == -unlimited ? -infinity : limits.lower;
  joint.upper = limits.upper == unlimited ? infinity : limits.upper;
  if (joint.lower > joint.upper) {
    place.warn(text("lower limit ", joint.lower, " ", unit, " is above the upper limit ",
                    joint.upper, " ", unit, ": taken for none, as in Bullet"));
    joint.lower = -infinity;
    joint.upper = infinity;
  }
  require_at_most(farthest, std::max(joint.lower, -farthest), "lower limit", unit, place);
  require_at_most(farthest, std::min(joint.upper, farthest), "upper limit", unit, place);
  const bool endless = std::isinf(joint.lower) && std::isinf(joint.upper);
  if (endless && joint.type == Joint::Type::revolute) joint.type = Joint::Type::continuous;
}

void set_limits(Joint& joint, const urdf::JointLimits* limits, const UrdfPlace& place) {
  const bool linear = joint.type == Joint::Type::prismatic;
  joint.lower = -infinity;
  joint.upper = joint.speed = joint.effort = infinity;
  if (!limits) return;  // it turns without end
  joint.speed = limit_or_none(limits->velocity, "velocity", linear ? "m/s" : "rad/s", place);
  joint.effort = limit_or_none(limits->effort, "effort", linear ? "N" : "N m", place);
  if (joint.type != Joint::Type::continuous) set_position_limits(joint, *limits, place);
}

double not_negative(double value, const char* name, const UrdfPlace& place) {
  if (value >= 0.0) return value;
  place.warn(text(name, " ", value, ", must be >= 0: taken for 0"));
  return 0.0;
}

Joint::Type joint_type(const urdf::Joint& joint, const UrdfPlace& place) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return Joint::Type::revolute;
    case urdf::Joint::CONTINUOUS:
      return Joint::Type::continuous;
    case urdf::Joint::PRISMATIC:
      return Joint::Type::prismatic;
    default:
      place.refuse("is of an unknown type, must be revolute, continuous, prismatic or fixed");
  }
}

/// Whether a shape has the size it must have; warns if it does not.
bool has_size(const Geometry& geometry, const UrdfPlace& place) {
  const Eigen::Vector3d& size = geometry.size;
  const bool is_round = geometry.type != Geometry::Type::box;
  const bool is_ball = geometry.type == Geometry::Type::sphere;
  if (size[0] > 0.0 && (is_ball || size[2] > 0.0) && (is_round || size[1] > 0.0)) return true;
  if (!is_round) {
    place.warn(
        text("box of size ", size[0], " ", size[1], " ", size[2], " m, must all be > 0: left out"));
  } else if (is_ball) {
    place.warn(text("sphere of radius ", size[0], " m, must be > 0: left out"));
  } else {
    place.warn(text(geometry.type == Geometry::Type::capsule ? "capsule" : "cylinder",
                    " of radius ", size[0], " m and length ", size[2],
                    " m, must be > 0: left out"));
  }
  return false;
}

bool set_mesh(Geometry& geometry, const urdf::Mesh& mesh, const MeshPlaces& places,
              const UrdfPlace& place) {
  geometry.type = Geometry::Type::mesh;
  geometry.scale = vector_from_urdf(mesh.scale);
  if ((geometry.scale.array() == 0.0).any()) {
    place.warn(text("mesh \"", mesh.filename, "\" of scale ", mesh.scale.x, " ", mesh.scale.y, " ",
                    mesh.scale.z, ", must not be 0: left out"));
    return false;
  }
  geometry.mesh = mesh_path(mesh.filename, places, place.text());
  return true;
}

std::optional<Geometry> geometry_from_urdf(const urdf::Geometry& shape, bool is_capsule,
                                           const urdf::Pose& origin, const MeshPlaces& places,
                                           const UrdfPlace& place) {
  Geometry geometry;
  geometry.X_body_shape = pose_from_urdf(origin);
  if (shape.type == urdf::Geometry::BOX) {
    geometry.type = Geometry::Type::box;
    geometry.size = vector_from_urdf(static_cast<const urdf::Box&>(shape).dim);
  } else if (shape.type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = static_cast<const urdf::Cylinder&>(shape);
    geometry.type = is_capsule ? Geometry::Type::capsule : Geometry::Type::cylinder;
    geometry.size = {cylinder.radius, 0.0, cylinder.length};
  } else if (shape.type == urdf::Geometry::SPHERE) {
    geometry.type = Geometry::Type::sphere;
    geometry.size = {static_cast<const urdf::Sphere&>(shape).radius, 0.0, 0.0};
  } else {
    if (set_mesh(geometry, static_cast<const urdf::Mesh&>(shape), places, place)) return geometry;
    return std::nullopt;
  }
  if (!has_size(geometry, place)) return std::nullopt;
  return geometry;
}

/// A capsule as it is drawn: a cylinder and a ball at each end.
std::vector<Geometry> parts_of_capsule(const Geometry& capsule) {
  std::vector<Geometry> parts(3, capsule);
  parts[0].type = Geometry::Type::cylinder;
  for (const std::size_t end : {1U, 2U}) {
    parts[end].type = Geometry::Type::sphere;
    parts[end].size = {capsule.size[0], 0.0, 0.0};
    const double along = (end == 1 ? 0.5 : -0.5) * capsule.size[2];
    parts[end].X_body_shape.translate(Eigen::Vector3d(0.0, 0.0, along));
  }
  return parts;
}

}  // namespace

Eigen::Isometry3d pose_from_urdf(const urdf::Pose& pose) {
  Eigen::Quaterniond rotation;
  pose.rotation.getQuaternion(rotation.x(), rotation.y(), rotation.z(), rotation.w());
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = rotation.normalized().toRotationMatrix();
  X.translation() = vector_from_urdf(pose.position);
  return X;
}

Inertial inertial_from_urdf(const urdf::Inertial& inertial, const UrdfPlace& place) {
  Inertial in_com;
  in_com.mass = inertial.mass;
  in_com.inertia << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,                //
      inertial.ixz, inertial.iyz, inertial.izz;
  const bool is_point = in_com.inertia.isZero(0.0);
  if (std::abs(in_com.mass) < least_mass) {
    if (in_com.mass != 0.0) {
      place.warn(text("mass ", in_com.mass, " kg: taken for none"));
    } else if (!is_point) {
      place.warn("its mass is 0, its inertia not: taken for none");
    }
    return {};
  }
  require_at_most(largest, in_com.mass, "mass", "kg", place);
  if (in_com.mass < 0.0)
    place.warn(text("mass ", in_com.mass,
                    " kg, must be >= 0: counted as it is, with what it is fixed to"));
  if (!is_point) judge_moments(in_com.inertia, in_com.mass, place);
  return pose_from_urdf(inertial.origin) * in_com;
}

bool has_mass(const urdf::Link& link) {
  if (link.inertial && std::abs(link.inertial->mass) >= least_mass) return true;
  return std::any_of(link.child_links.begin(), link.child_links.end(),
                     [](const auto& child) { return has_mass(*child); });
}

Joint joint_from_urdf(const urdf::Joint& joint, const UrdfPlace& place) {
  Joint result;
  result.name = joint.name;
  result.type = joint_type(joint, place);
  const Eigen::Vector3d axis = vector_from_urdf(joint.axis);
  if (!(axis.stableNorm() > 1e-6)) {
    place.refuse(text("axis ", axis[0], " ", axis[1], " ", axis[2], ", must not be zero"));
  }
  result.axis = axis.stableNormalized();
  if (joint.dynamics) {
    result.damping = not_negative(joint.dynamics->damping, "damping", place);
    result.friction = not_negative(joint.dynamics->friction, "friction", place);
  }
  set_limits(result, joint.limits.get(), place);
  return result;
}

std::vector<Geometry> visual_from_urdf(const urdf::Visual& visual, bool is_capsule,
                                       const MeshPlaces& places, const UrdfPlace& place) {
  auto geometry =
      geometry_from_urdf(*visual.geometry, is_capsule, visual.origin, places, place.part("visual"));
  if (!geometry) return {};
  geometry->has_colour = visual.material && visual.material->texture_filename.empty();
  if (geometry->has_colour) {
    const urdf::Color& colour = visual.material->color;
    geometry->colour = Eigen::Vector4f(colour.r, colour.g, colour.b, colour.a).cast<double>();
  }
  if (is_capsule) return parts_of_capsule(*geometry);
  return {*geometry};
}

std::vector<Geometry> collision_from_urdf(const urdf::Collision& collision, bool is_capsule,
                                          const MeshPlaces& places, const UrdfPlace& place) {
  auto geometry = geometry_from_urdf(*collision.geometry, is_capsule, collision.origin, places,
                                     place.part("collision"));
  if (!geometry) return {};
  return {*geometry};
}

}  // namespace seam
