#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "shapes.hpp"
#include <seam/robot_model.hpp>

namespace seam {

/// A body of a robot as it collides.
struct CollidingBody {
  int link = -1;  // -1: the base
  const BodyShape* shape = nullptr;
  Eigen::Isometry3d X_body_link = Eigen::Isometry3d::Identity();  // of the shape
};

/// The joints from one body over another to a third.
struct TwoJoints {
  int first, second;

  /// Whether both are within their limits, or at most 0.01 [rad or m] beyond.
  bool are_within_limits(const RobotModel& model, double q_first, double q_second) const noexcept;
};

/// From link a to link b, a < b; nothing where more or fewer joints are between them.
std::optional<TwoJoints> two_joints_between(const RobotModel& model, int a, int b);

/// Whether two bodies always are 20 mm apart or more (Bullet makes no contacts then) while these joints, which are all between
/// them, are within their limits. What is within a cell of joint positions is proved at its centre: there the bodies are
/// further apart than the joints can move them inside the cell. No may also mean that 3000 distances of parts did not suffice.
bool never_meet(const RobotModel& model, const CollidingBody& a, const CollidingBody& b,
                const TwoJoints& joints);

}  // namespace seam
