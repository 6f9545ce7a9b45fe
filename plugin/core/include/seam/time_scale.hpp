#pragma once

#include <seam/export.hpp>

namespace SEAM_API seam {

/// A clock that can be slowed, hastened and stopped without a step: the time s of a motion against real
/// time t. The rate ρ = ds/dt moves to another over a given time T along the quintic that begins with
/// the ρ, ρ̇, ρ̈ of the moment, also in the midst of another move, and ends with ρ̇ = ρ̈ = 0; from rest
/// that is 10u³ − 15u⁴ + 6u⁵, u = t/T. A motion y(s) has in real time
///     ẏ = y′ρ,   ÿ = y″ρ² + y′ρ̇,   y⃛ = y‴ρ³ + 3y″ρρ̇ + y′ρ̈
/// all continuous, on the same path. T is halved until ρ never falls below 0.
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
  double rate_at(double u) const noexcept;
  bool never_negative() const noexcept;

  double from_ = 1.0, to_ = 1.0;
  double slope_ = 0.0, curvature_ = 0.0;  // ρ̇, ρ̈ when the rate began to move
  double over_ = 0.0;                     // [s]
  double elapsed_ = 0.0;                  // [s] since the rate began to move
};

}  // namespace seam
