#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// What keeps n joints from the accelerations that they are asked for, from one tick to the next. With a the acceleration that
/// was asked for in a tick of dt, all corrections in it, and q̇₋, q̇ the velocities before and after it
///     e = a − (q̇ − q̇₋)/dt
///     ê ← ê + (1 − exp(−ω·dt))(e − ê),  held within ± most
/// A torque d that no model knows of leaves e = (M + J)⁻¹d, so that ê in the acceleration of computed torque (see ComputedTorque)
/// is the torque (M + J)ê = d̂, after 1/ω: the disturbance observer of K. Ohnishi, M. Shibata and T. Murakami (IEEE/ASME Trans.
/// Mechatronics 1, 1996), which needs no second call of the inverse dynamics in this form. White noise of standard deviation σ in
/// the measured velocity makes one of about ω·σ in ê, as the feedback makes one of Kd·σ.
/// Neither allocates nor throws after construction.
class DisturbanceObserver {
 public:
  /// @param bandwidth  [rad/s] ω ≥ 0; 0: observes nothing
  /// @param most       n [rad/s² or m/s²] ≥ 0
  /// @throws Error  the bandwidth is negative or not finite
  DisturbanceObserver(double bandwidth, const Eigen::VectorXd& most);

  bool observes() const noexcept { return bandwidth_ > 0.0; }  // else it costs nothing
  /// Begins anew, with no correction.
  void reset() noexcept;
  /// The tick that ends now says nothing: no state, or drives that could not do what they were asked for.
  void hold() noexcept { before_ = false; }
  /// What was asked for in the last tick of dt [s], and the velocity now.
  void observe(double dt, const Eigen::VectorXd& asked, const Eigen::VectorXd& qd) noexcept;
  const Eigen::VectorXd& correction() const noexcept {
    return correction_;
  }  // ê, n [rad/s² or m/s²]

 private:
  double bandwidth_;
  Eigen::VectorXd most_;
  Eigen::VectorXd correction_;
  Eigen::VectorXd qd_;   // before
  bool before_ = false;  // there is one
};

}  // namespace seam
