#pragma once

#include <cmath>

#include <Eigen/Core>

#include <seam/robot_model.hpp>

namespace seam::test {

inline constexpr double inertia = 0.2;  // [kg m²] of the wheel

/// A wheel about a vertical axis: torque is inertia times acceleration.
inline RobotModel wheel() {
  RobotModel model;
  model.name = "wheel";
  model.joints.resize(1);
  model.bodies.resize(1);
  model.joints[0].name = "turn";
  model.joints[0].type = Joint::Type::continuous;
  model.joints[0].lower = -INFINITY;
  model.joints[0].upper = INFINITY;
  model.joints[0].speed = model.joints[0].effort = INFINITY;
  model.bodies[0].link = "wheel";
  model.bodies[0].inertial.mass = 1.0;
  model.bodies[0].inertial.inertia = Eigen::Vector3d(0.15, 0.15, inertia).asDiagonal();
  return model;
}

/// Its state, or its torque.
inline Eigen::VectorXd one(double value) {
  return Eigen::VectorXd::Constant(1, value);
}

}  // namespace seam::test
