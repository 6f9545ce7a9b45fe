#pragma once

#include <Eigen/Geometry>

#include <seam/robot_model.hpp>

namespace seam {

/// A box of these edges [m] about the middle that `X` puts it at.
inline Geometry box(const Eigen::Isometry3d& X, const Eigen::Vector3d& edges) {
  Geometry solid;
  solid.type = Geometry::Type::box;
  solid.X_body_shape = X;
  solid.size = edges;
  return solid;
}

/// A sphere about the origin; radius in [m].
inline Geometry sphere(double radius) {
  Geometry solid;
  solid.type = Geometry::Type::sphere;
  solid.size.setConstant(radius);
  return solid;
}

/// A cylinder from the origin to a place other than it; both in [m].
inline Geometry rod(const Eigen::Vector3d& to, double radius) {
  Geometry solid;
  solid.type = Geometry::Type::cylinder;
  solid.X_body_shape = Eigen::Translation3d(0.5 * to) *
                       Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to);
  solid.size << radius, 0.0, to.norm();
  return solid;
}

/// The same in a colour, red green blue in 0 to 1.
inline Geometry coloured(Geometry solid, double red, double green, double blue) {
  solid.colour << red, green, blue, 1.0;
  solid.has_colour = true;
  return solid;
}

}  // namespace seam
