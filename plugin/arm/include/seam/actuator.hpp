#pragma once

#include <limits>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/per_joint.hpp>
#include <seam/robot_model.hpp>

namespace SEAM_API seam {

/// What becomes of a commanded torque on its way to the joint; by default nothing.
struct ActuatorSettings {
  PerJoint quantum = 0.0;                                   // [N·m] step of the command, 0: none
  bool limit_effort = false;                                // to the URDF's effort limits
  PerJoint rate = std::numeric_limits<double>::infinity();  // [N·m/s] largest rate
  PerJoint lag = 0.0;  // [s] time constant T of a first-order lag, 0: none
};

/// Commanded torque u in, delivered torque t out, over a tick of dt:
///     u₁ = quantum·round(u/quantum)
///     u₂ = u₁ within ± effort
///     u₃ ← u₃ + (u₂ − u₃ within ± rate·dt)
///     Tṫ + t = u₃ held over the tick: t ← t + (1 − exp(−dt/T))(u₃ − t)
/// It begins delivering u₂ of what is commanded first. Neither allocates nor throws after construction.
class Actuator {
 public:
  /// @throws Error  a setting is negative or not finite (a rate may be infinite, but not 0), or there are not as many as joints
  Actuator(const RobotModel& model, const ActuatorSettings& settings);

  /// @param dt  [s] > 0
  /// @return    what is delivered during the tick, n [N·m]
  const Eigen::VectorXd& deliver(double dt, const Eigen::VectorXd& commanded) noexcept;
  /// In the last tick a joint's torque was held back by its effort limit or its rate.
  bool limited() const noexcept { return limited_; }
  /// What is delivered now, if that was commanded last.
  const Eigen::VectorXd& delivered(const Eigen::VectorXd& commanded) const noexcept {
    return ideal_ ? commanded : delivered_;
  }

 private:
  Eigen::VectorXd quantum_, limit_, rate_, lag_;
  bool ideal_;                 // delivers what is commanded
  Eigen::VectorXd driven_;     // u₃
  Eigen::VectorXd delivered_;  // t
  bool begun_ = false;
  bool limited_ = false;
};

}  // namespace seam
