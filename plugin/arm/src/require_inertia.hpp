#pragma once

#include <string>

#include <seam/robot_model.hpp>

namespace seam {

/// Looks at the joints' inertia matrix M(q) where bodies have no mass, no inertia or a negative moment, in random positions and in those where joints
/// line up (see RobotModel::read). Without inertia almost everywhere, points that have mass become balls, with a warning
/// each; if that does not help, or if M is negative anywhere, the robot is refused. Without inertia here and there, it is
/// warned of. A robot whose bodies' moments are all positive is left alone, but for joints that move less than 1e-15 kg m² or kg:
/// Bullet would not move them.
/// @param path  of the URDF
/// @throws Error
void require_inertia(RobotModel& model, const std::string& path);

}  // namespace seam
