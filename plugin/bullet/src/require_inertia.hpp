#pragma once

#include <string>

#include <Eigen/Core>

#include <seam/robot_model.hpp>

namespace seam {

/// The joints' inertia matrix M(q) = Σ over the bodies of m·J_vᵀJ_v + J_ωᵀI·J_ω, n × n.
Eigen::MatrixXd inertia_matrix(const RobotModel& model, const Eigen::VectorXd& q);

/// Looks at M(q) where bodies have no mass, no inertia or a negative moment, in random positions and in those where joints
/// line up (see RobotModel::read). Without inertia almost everywhere, points that have mass become balls, with a warning
/// each; if that does not help, or if M is negative anywhere, the robot is refused. Without inertia here and there, it is
/// warned of. A robot whose bodies' moments are all positive is left alone.
/// @param path  of the URDF
/// @throws Error
void require_inertia(RobotModel& model, const std::string& path);

}  // namespace seam
