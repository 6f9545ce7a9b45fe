#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/join.hpp>

namespace SEAM_API seam {

/// The feedback, and which acceleration it is added to (see ComputedTorque).
struct ControlSettings {
  /// `matched`: the acceleration that Bullet's semi-implicit integrator needs to arrive at the next
  /// reference position exactly. `plain`: the reference acceleration at the present time, which
  /// leaves an error of order dt.
  enum class Reference { matched, plain };

  double Kp = 400.0;                         // [1/s²] feedback on position
  double Kd = 40.0;                          // [1/s] feedback on velocity
  Reference reference = Reference::matched;  // of the acceleration
};

/// Gains that act once per tick of dt as Kp and Kd act all the time: an error e with ë = −Kd·ė − Kp·e has the poles λ₁ and λ₂,
/// and semi-implicit steps under
///     Kp' = (1 − z₁)(1 − z₂)/dt²,   Kd' = (1 − z₁z₂)/dt,   z = exp(λ·dt)
/// have the poles z: stable at any dt, and Kp' → Kp, Kd' → Kd as dt → 0.
struct TickGains {
  double Kp = 0.0;  // [1/s²]
  double Kd = 0.0;  // [1/s]

  TickGains() = default;
  /// Of a tick of dt [s].
  TickGains(const ControlSettings& settings, double dt) noexcept;
};

/// Computed torque: inverse dynamics at an acceleration that follows a joint reference. (q, q̇) in,
/// torque out; it knows no btMultiBody. With the gains of the tick
///     matched  q̇*ₖ₊₁ = (q_ref[k+1] − q_ref[k])/dt
///              q̈ₖ = (q̇*ₖ₊₁ − q̇*ₖ)/dt + Kd'(q̇*ₖ − q̇ₖ) + Kp'(q_ref[k] − qₖ)
///     plain    q̈ₖ = q̈_ref[k] + Kd'(q̇_ref[k] − q̇ₖ) + Kp'(q_ref[k] − qₖ)
/// Where dt changes to dt', q̇*ₖ goes on as if all ticks had been of dt', q̇*ₖ + ½(dt − dt')q̈_ref[k], so that the torque does
/// not step; what the joints' velocity is off by that (10⁻³ rad/s where dt changes by 0.2 ms at 10 rad/s²) the feedback
/// takes away.
/// Construction allocates; nothing else does, nor throws.
class ComputedTorque {
 public:
  /// Takes gains as they are: see Controller, which checks them.
  ComputedTorque(InverseDynamics dynamics, const ControlSettings& settings);

  /// The velocity [rad/s] with which the reference begins, n values.
  void start(const Eigen::VectorXd& velocity) noexcept;
  /// The velocity that the joints should have now, n values: q̇*ₖ, or where it began.
  const Eigen::VectorXd& velocity() const noexcept { return matched_velocity_; }
  /// Goes on from another one, as if the joints should have had that.
  void go_on(const Eigen::VectorXd& velocity) noexcept { matched_velocity_ = velocity; }
  /// Gravity [m/s²] in the frame of the robot's root link.
  void set_gravity(const Eigen::Vector3d& gravity) noexcept { dynamics_.set_gravity(gravity); }
  /// Torque [N·m] for the tick from now to now + dt.
  /// @param dt    [s] > 0
  /// @param now   reference at the beginning of the tick
  /// @param next  reference position at its end
  void torque(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd, const Sample& now,
              const Eigen::VectorXd& next, Eigen::VectorXd& torque) noexcept;
  /// The same without a state: as if the joints were where the reference is.
  void torque(double dt, const Sample& now, const Eigen::VectorXd& next,
              Eigen::VectorXd& torque) noexcept;

 private:
  const Eigen::VectorXd& plan(double dt, const Sample& now, const Eigen::VectorXd& next) noexcept;

  InverseDynamics dynamics_;
  ControlSettings settings_;
  TickGains gains_;
  double dt_;                         // [s] of the last tick; NaN before the first
  Eigen::VectorXd matched_velocity_;  // q̇*ₖ
  Eigen::VectorXd next_velocity_;     // q̇*ₖ₊₁
  Eigen::VectorXd acceleration_;
};

}  // namespace seam
