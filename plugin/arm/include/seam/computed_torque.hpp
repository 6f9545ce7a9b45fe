#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/disturbance_observer.hpp>
#include <seam/export.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/join.hpp>
#include <seam/per_joint.hpp>

namespace SEAM_API seam {

/// The feedback, which acceleration it is added to, and what is done about what the model's bodies do not say (see
/// ComputedTorque).
struct ControlSettings {
  /// `matched`: the acceleration that Bullet's semi-implicit integrator needs to arrive at the next
  /// reference position exactly. `plain`: the reference acceleration at the present time, which
  /// leaves an error of order dt.
  enum class Reference { matched, plain };

  /// Feedback in accelerations: a joint that moves the inertia m, its rotor's included, is held with the stiffness m·Kp [N·m/rad]
  /// and the damping m·Kd [N·m·s/rad]; its error has the natural frequency √Kp [rad/s] and the damping ratio Kd/(2√Kp). A
  /// torque d that nobody knows of leaves an error of d/(m·Kp), so that a wrist of 0.01 kg m² wants a larger Kp than a shoulder.
  PerJoint Kp = 400.0;                       // [1/s²] on position
  PerJoint Kd = 40.0;                        // [1/s] on velocity
  Reference reference = Reference::matched;  // of the acceleration
  double friction_share = 1.0;               // s, of the model's friction that is believed
  double friction_velocity = 0.02;  // [rad/s or m/s] v₀, below which Coulomb friction fades
  /// [rad/s] ω of the disturbance observer, 0: none. It is off unless you ask for it: on an ideal arm it observes rounding alone, but that would
  /// change the last bits of every recording. With 60 the effect of a wrong mass or friction is gone after 20 to 50 ms. Noise of
  /// standard deviation σ in the measured velocity becomes a noise of about (Kd + ω)σ in acceleration, so that an ω far above Kd
  /// wants a good sensor. On the published PA-10 60 is right up to σ = 0.003 rad/s; at 0.01 rad/s the drives come to their rate limit, and 20
  /// tracks better. Drives that lag want ω below 0.3 / lag.
  double observer = 0.0;
  /// Share of a joint's effort limit that the observer may use up, reckoned with the inertia that the joint moves where the
  /// controller is made; in a joint without limit, of what Kp makes of 1 rad or m.
  double most_correction = 0.5;
};

/// Gains that act once per tick of dt as Kp and Kd act all the time: an error e with ë = −Kd·ė − Kp·e has the poles λ₁ and λ₂,
/// and semi-implicit steps under
///     Kp' = (1 − z₁)(1 − z₂)/dt²,   Kd' = (1 − z₁z₂)/dt,   z = exp(λ·dt)
/// have the poles z: stable at any dt, and Kp' → Kp, Kd' → Kd as dt → 0.
struct TickGains {
  double Kp = 0.0;  // [1/s²]
  double Kd = 0.0;  // [1/s]

  /// Of a tick of dt [s].
  TickGains(double Kp_in_time, double Kd_in_time, double dt) noexcept;
};

/// Computed torque: inverse dynamics (ID) at an acceleration that follows a joint reference, and what the joints' rotors J and friction
/// b, c of the model add. (q, q̇) in, torque out; it knows no btMultiBody.
///     torque = ID(q, q̇, q̈ₖ + ê) + J∘(q̈ₖ + ê) + s·(b∘q̇* + c∘tanh(q̇*/v₀))
/// Friction goes by the velocity that the reference has at the tick's end, q̇* (plain: at its beginning), not by the measured one: so it neither chatters
/// at rest nor steps where the motion turns. ê is the disturbance observer's. With the gains of the tick
///     matched  q̇*ₖ₊₁ = (q_ref[k+1] − q_ref[k])/dt
///              q̈ₖ = (q̇*ₖ₊₁ − q̇*ₖ)/dt + Kd'(q̇*ₖ − q̇ₖ) + Kp'(q_ref[k] − qₖ)
///     plain    q̈ₖ = q̈_ref[k] + Kd'(q̇_ref[k] − q̇ₖ) + Kp'(q_ref[k] − qₖ)
/// Where dt changes to dt', q̇*ₖ goes on as if all ticks had been of dt', q̇*ₖ + ½(dt − dt')q̈_ref[k], so that the torque does
/// not step; what the joints' velocity is off by that (10⁻³ rad/s where dt changes by 0.2 ms at 10 rad/s²) the feedback
/// takes away.
/// Construction allocates; nothing else does, nor throws.
class ComputedTorque {
 public:
  /// @throws Error  gains that are negative, not finite, or not as many as joints; a share, velocity or bandwidth that is negative
  ///                or not finite; and what InverseDynamics refuses
  /// @param posture  n [rad or m] in which the observer's bound is reckoned
  ComputedTorque(const RobotModel& model, const ControlSettings& settings,
                 const Eigen::VectorXd& posture);

  /// The velocity [rad/s] with which the reference begins, n values.
  void start(const Eigen::VectorXd& velocity) noexcept;
  /// The velocity that the joints should have now, n values: q̇*ₖ, or where it began.
  const Eigen::VectorXd& velocity() const noexcept { return matched_velocity_; }
  /// Goes on from another one, as if the joints should have had that.
  void go_on(const Eigen::VectorXd& velocity) noexcept { matched_velocity_ = velocity; }
  /// What the observer has found is kept over the tick that ends now, which says nothing: see DisturbanceObserver::hold.
  void hold_observer() noexcept { observer_.hold(); }
  /// It is let go of, and the observer begins anew.
  void reset_observer() noexcept { observer_.reset(); }
  const DisturbanceObserver& observer() const noexcept { return observer_; }  // to look at
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
  void set_gains(double dt) noexcept;
  const Eigen::VectorXd& plan(double dt, const Sample& now, const Eigen::VectorXd& next) noexcept;
  void add_drives(const Sample& now, Eigen::VectorXd& torque) const noexcept;

  InverseDynamics dynamics_;
  ControlSettings::Reference reference_;
  double dt_;                         // [s] of the last tick; NaN before the first
  Eigen::VectorXd Kp_, Kd_;           // n, of the tick
  Eigen::VectorXd matched_velocity_;  // q̇*ₖ
  Eigen::VectorXd next_velocity_;     // q̇*ₖ₊₁
  Eigen::VectorXd acceleration_;
  bool has_drives_;  // rotors or friction that it knows of
  double per_friction_velocity_;
  Eigen::VectorXd rotors_, viscous_, coulomb_;  // n, what is believed of them
  DisturbanceObserver observer_;
  Eigen::VectorXd Kp_in_time_, Kd_in_time_;  // n
};

}  // namespace seam
