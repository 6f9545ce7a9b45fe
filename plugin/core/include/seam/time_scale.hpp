#pragma once

#include <seam/export.hpp>

namespace SEAM_API seam {

/// A clock that can be slowed, hastened and stopped without a step: the time s of a motion against real
/// time t. From the rate ρ₀ = ds/dt, ρ̇₀, ρ̈₀ of the moment, also in the midst of another move, the rate
/// moves to ρ₁ in a time T, and ends there with ρ̇ = ρ̈ = 0:
///     ρ(t) = ρ₀ + D(t) + (ρ₁ − ρ₀ − D(Tᵦ))·(10u³ − 15u⁴ + 6u⁵),   u = t/T
///     D(t) = Tᵦρ̇₀(w − w³ + w⁴/2) + Tᵦ²ρ̈₀(w²/2 − 2w³/3 + w⁴/4),    w = min(t/Tᵦ, 1)
/// D brings the present slope to 0 in a time Tᵦ ≤ T. From rest ρ goes straight to ρ₁. A motion y(s) has in
/// real time
///     ẏ = y′ρ,   ÿ = y″ρ² + y′ρ̇,   y⃛ = y‴ρ³ + 3y″ρρ̇ + y′ρ̈
/// all continuous, on the same path.
///
/// ρ stays between ρ₀ and ρ₁. Only a slope that leads away from there, or ends too close, takes it further:
/// by 0.1·max(1, ρ₀) at the most, and downwards by no more than ρ₀/2. Tᵦ is the longest time that keeps to
/// that, and no longer than the move in progress would have gone on.
class TimeScale {
 public:
  /// Moves the rate from what it is to another, over a time. False, and no change, unless rate ≥ 0 and
  /// over is 1e-6 to 1e6 s.
  bool change(double rate, double over) noexcept;
  /// Advances real time by dt [s] ≥ 0. @return  the time of the motion that goes by [s]
  double advance(double dt) noexcept;

  double rate() const noexcept;            // ρ
  double rate_change() const noexcept;     // ρ̇ [1/s]
  double rate_curvature() const noexcept;  // ρ̈ [1/s²]
  /// s runs as t does.
  bool is_real_time() const noexcept { return elapsed_ >= over_ && to_ == 1.0; }

 private:
  double motion_time(double elapsed) const noexcept;

  double to_ = 1.0;                       // ρ₁
  double gap_ = 0.0;                      // ρ₀ + D(Tᵦ) − ρ₁
  double slope_ = 0.0, curvature_ = 0.0;  // ρ̇₀, ρ̈₀
  double over_ = 0.0;                     // T [s]
  double braking_ = 1.0;                  // Tᵦ [s]
  double elapsed_ = 0.0;                  // t [s]
};

}  // namespace seam
