#pragma once

#include <Eigen/Core>

#include <seam/export.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/join.hpp>

namespace SEAM_API seam {

struct ControlSettings {
  /// `matched`: the acceleration that Bullet's semi-implicit integrator needs to arrive at the next
  /// reference position exactly. `plain`: the reference acceleration at the present time, which
  /// leaves an error of order dt.
  enum class Reference { matched, plain };

  // The feedback acts once per tick: stable while Kd·dt + Kp·dt²/2 < 2, by default dt < 41 ms.
  double Kp = 400.0;  // [1/s²] feedback on position
  double Kd = 40.0;   // [1/s] feedback on velocity
  Reference reference = Reference::matched;

  /// Whether the feedback is stable at a tick dt [s].
  bool stable_at(double dt) const noexcept { return Kd * dt + 0.5 * Kp * dt * dt < 2.0; }
};

/// Computed torque: inverse dynamics at an acceleration that follows a joint reference. (q, q̇) in,
/// torque out; it knows no btMultiBody.
///     matched  q̇*ₖ₊₁ = (q_ref[k+1] − q_ref[k])/dt
///              q̈ₖ = (q̇*ₖ₊₁ − q̇*ₖ)/dt + Kd(q̇*ₖ − q̇ₖ) + Kp(q_ref[k] − qₖ)
///     plain    q̈ₖ = q̈_ref[k] + Kd(q̇_ref[k] − q̇ₖ) + Kp(q_ref[k] − qₖ)
/// Construction allocates; `torque` does not, and does not throw.
class ComputedTorque {
 public:
  ComputedTorque(InverseDynamics dynamics, const ControlSettings& settings);

  /// The velocity [rad/s] with which the reference begins, n values.
  void start(const Eigen::VectorXd& velocity) noexcept { matched_velocity_ = velocity; }
  /// Gravity [m/s²] in the frame of the robot's root link.
  void set_gravity(const Eigen::Vector3d& gravity) noexcept { dynamics_.set_gravity(gravity); }
  /// Torque [N·m] for the tick from now to now + dt.
  /// @param dt    [s] > 0
  /// @param now   reference at the beginning of the tick
  /// @param next  reference position at its end
  void torque(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd, const Sample& now,
              const Eigen::VectorXd& next, Eigen::VectorXd& torque) noexcept;

 private:
  InverseDynamics dynamics_;
  ControlSettings settings_;
  Eigen::VectorXd matched_velocity_;  // q̇*ₖ
  Eigen::VectorXd next_velocity_;     // q̇*ₖ₊₁
  Eigen::VectorXd acceleration_;
};

}  // namespace seam
