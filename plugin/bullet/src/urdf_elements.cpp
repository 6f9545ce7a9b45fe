#include "urdf_elements.hpp"

#include <limits>
#include <sstream>

#include <Eigen/Eigenvalues>

#include <seam/error.hpp>

namespace seam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounded = 0.05;  // what CAD programs and their users make of flat bodies

template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  (out << ... << parts);
  return out.str();
}

Eigen::Vector3d vector_from_urdf(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

void check_principal_moments(const Eigen::Vector3d& moments, const std::string& where) {
  const std::string found = text("inertia has the principal moments ", moments[0], ", ", moments[1],
                                 ", ", moments[2], " kg m^2, ");
  if (!(moments[0] > 0.0)) throw Error(where, found + "must all be > 0");
  if (moments[2] > (1.0 + rounded) * (moments[0] + moments[1])) {
    throw Error(where, found + "none may exceed the sum of the other two by more than 5 %");
  }
}

void check_not_negative(double value, const char* name, const char* unit,
                        const std::string& where) {
  if (value < 0.0) throw Error(where, text(name, " limit ", value, " ", unit, ", must be >= 0"));
}

void set_limits(Joint& joint, const urdf::JointLimits* limits, const std::string& where) {
  const bool linear = joint.type == Joint::Type::prismatic;
  const bool endless = joint.type == Joint::Type::continuous;
  joint.lower = endless ? -infinity : limits->lower;
  joint.upper = endless ? infinity : limits->upper;
  joint.speed = limits ? limits->velocity : infinity;
  joint.effort = limits ? limits->effort : infinity;
  if (joint.lower > joint.upper) {
    const char* unit = linear ? " m" : " rad";
    throw Error(where, text("lower limit ", joint.lower, unit, ", must be <= upper limit ",
                            joint.upper, unit));
  }
  check_not_negative(joint.speed, "velocity", linear ? "m/s" : "rad/s", where);
  check_not_negative(joint.effort, "effort", linear ? "N" : "N m", where);
}

Joint::Type joint_type(const urdf::Joint& joint, const std::string& where) {
  const char* const refusal = "joint, must be revolute, continuous, prismatic or fixed";
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return Joint::Type::revolute;
    case urdf::Joint::CONTINUOUS:
      return Joint::Type::continuous;
    case urdf::Joint::PRISMATIC:
      return Joint::Type::prismatic;
    case urdf::Joint::FLOATING:
      throw Error(where, text("is a floating ", refusal));
    case urdf::Joint::PLANAR:
      throw Error(where, text("is a planar ", refusal));
    default:
      throw Error(where, text("is an unknown ", refusal));
  }
}

void set_size(Geometry& geometry, Geometry::Type type, const Eigen::Vector3d& size,
              const std::string& where) {
  geometry.type = type;
  geometry.size = size;
  switch (type) {
    case Geometry::Type::box:
      if (size.minCoeff() > 0.0) return;
      throw Error(where,
                  text("box of size ", size[0], " ", size[1], " ", size[2], " m, must all be > 0"));
    case Geometry::Type::cylinder:
      if (size[0] > 0.0 && size[2] > 0.0) return;
      throw Error(where, text("cylinder of radius ", size[0], " m and length ", size[2],
                              " m, must be > 0"));
    default:
      if (size[0] > 0.0) return;
      throw Error(where, text("sphere of radius ", size[0], " m, must be > 0"));
  }
}

void set_mesh(Geometry& geometry, const urdf::Mesh& mesh, const MeshPlaces& places,
              const std::string& where) {
  geometry.type = Geometry::Type::mesh;
  geometry.scale = vector_from_urdf(mesh.scale);
  if ((geometry.scale.array() == 0.0).any()) {
    throw Error(where, text("mesh \"", mesh.filename, "\" of scale ", mesh.scale.x, " ",
                            mesh.scale.y, " ", mesh.scale.z, ", must not be 0"));
  }
  geometry.mesh = mesh_path(mesh.filename, places, where);
}

Geometry geometry_from_urdf(const urdf::Geometry& shape, const urdf::Pose& origin,
                            const MeshPlaces& places, const std::string& where) {
  Geometry geometry;
  geometry.X_body_shape = pose_from_urdf(origin);
  if (shape.type == urdf::Geometry::BOX) {
    const auto& box = static_cast<const urdf::Box&>(shape);
    set_size(geometry, Geometry::Type::box, vector_from_urdf(box.dim), where);
  } else if (shape.type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = static_cast<const urdf::Cylinder&>(shape);
    set_size(geometry, Geometry::Type::cylinder, {cylinder.radius, 0.0, cylinder.length}, where);
  } else if (shape.type == urdf::Geometry::SPHERE) {
    const auto& sphere = static_cast<const urdf::Sphere&>(shape);
    set_size(geometry, Geometry::Type::sphere, {sphere.radius, 0.0, 0.0}, where);
  } else {
    set_mesh(geometry, static_cast<const urdf::Mesh&>(shape), places, where);
  }
  return geometry;
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

Inertial inertial_from_urdf(const urdf::Inertial& inertial, const std::string& where) {
  Inertial in_com;
  in_com.mass = inertial.mass;
  in_com.inertia << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,                //
      inertial.ixz, inertial.iyz, inertial.izz;
  if (in_com.mass == 0.0) return {};
  if (!(in_com.mass > 0.0)) throw Error(where, text("mass ", in_com.mass, " kg, must be >= 0"));
  if (!in_com.inertia.isZero(0.0))
    check_principal_moments(in_com.inertia.selfadjointView<Eigen::Lower>().eigenvalues(), where);
  return pose_from_urdf(inertial.origin) * in_com;
}

Joint joint_from_urdf(const urdf::Joint& joint, const std::string& where) {
  Joint result;
  result.name = joint.name;
  result.type = joint_type(joint, where);
  const Eigen::Vector3d axis = vector_from_urdf(joint.axis);
  if (!(axis.norm() > 1e-6)) {
    throw Error(where, text("axis ", axis[0], " ", axis[1], " ", axis[2], ", must not be zero"));
  }
  result.axis = axis.normalized();
  if (joint.mimic) {
    result.multiplier = joint.mimic->multiplier;
    result.offset = joint.mimic->offset;
  }
  set_limits(result, joint.limits.get(), where);
  return result;
}

Geometry visual_from_urdf(const urdf::Visual& visual, const MeshPlaces& places,
                          const std::string& where) {
  Geometry geometry =
      geometry_from_urdf(*visual.geometry, visual.origin, places, where + ": visual");
  geometry.has_colour = visual.material && visual.material->texture_filename.empty();
  if (geometry.has_colour) {
    const urdf::Color& colour = visual.material->color;
    geometry.colour = Eigen::Vector4f(colour.r, colour.g, colour.b, colour.a).cast<double>();
  }
  return geometry;
}

Geometry collision_from_urdf(const urdf::Collision& collision, const MeshPlaces& places,
                             const std::string& where) {
  return geometry_from_urdf(*collision.geometry, collision.origin, places, where + ": collision");
}

}  // namespace seam
