#pragma once

#include <Eigen/Core>

#include <seam/robot_model.hpp>

namespace seam {

/// What becomes of a commanded torque on its way to the joint; by default nothing.
struct ActuatorSettings {
  bool limit_effort = false;  // to the URDF's effort limits
  double lag = 0.0;           // [s] time constant T of a first-order lag, 0: none
};

/// Commanded torque in, delivered torque out:
///     Tṫ + t = u  (held over a tick of dt: t ← t + (1 − exp(−dt/T))(u − t)),  |u| ≤ effort
/// It begins delivering what is commanded first. Neither allocates nor throws after construction.
class Actuator {
 public:
  /// @throws Error  the lag is not finite and ≥ 0
  Actuator(const RobotModel& model, const ActuatorSettings& settings);

  /// @param dt  [s] > 0
  /// @return    what is delivered during the tick, n [N·m]
  const Eigen::VectorXd& deliver(double dt, const Eigen::VectorXd& commanded) noexcept;

 private:
  double lag_;
  Eigen::VectorXd limit_;
  Eigen::VectorXd delivered_;
  bool begun_ = false;
};

}  // namespace seam
