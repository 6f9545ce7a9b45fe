#pragma once

#include <Eigen/Core>

#include <seam/robot_model.hpp>

namespace seam {

/// What each drive moves at q while the others are at rest, its rotor included, n [kg m² or kg].
inline Eigen::VectorXd driven_inertia(const RobotModel& model, const Eigen::VectorXd& q) {
  Eigen::VectorXd inertia = model.moved_inertia(q);
  for (int i = 0; i < model.dof(); ++i)
    inertia(i) += model.joints[static_cast<std::size_t>(i)].rotor_inertia;
  return inertia;
}

}  // namespace seam
