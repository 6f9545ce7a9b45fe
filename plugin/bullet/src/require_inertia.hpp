#pragma once

#include <string>

#include <Eigen/Core>

#include <seam/robot_model.hpp>

namespace seam {

/// The joints' inertia matrix M(q) = Σ over the bodies of m·J_vᵀJ_v + J_ωᵀI·J_ω, n × n.
Eigen::MatrixXd inertia_matrix(const RobotModel& model, const Eigen::VectorXd& q);

/// Refuses a robot with moving bodies without mass or inertia, or with a negative moment, that leave a joint, or joints
/// together, without inertia somewhere (see RobotModel::read). A robot whose bodies' moments are all positive is left alone.
/// @param path  of the URDF
/// @throws Error
void require_inertia(const RobotModel& model, const std::string& path);

}  // namespace seam
