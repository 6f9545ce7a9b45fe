#pragma once

namespace seam {

/// A clock that can be slowed, hastened and stopped without a step: the time s of a motion against real
/// time t. The rate ρ = ds/dt moves from one value to the next by 10u³ − 15u⁴ + 6u⁵, u from 0 to 1 over a
/// given time, so that a motion y(s) has in real time
///     ẏ = y′ρ,   ÿ = y″ρ² + y′ρ̇,   y⃛ = y‴ρ³ + 3y″ρρ̇ + y′ρ̈
/// all continuous, on the same path.
class TimeScale {
 public:
  /// Moves the rate from what it is to another, over a time. False, and no change, unless rate ≥ 0 and
  /// over > 0 [s], both finite.
  bool change(double rate, double over) noexcept;
  /// Advances real time by dt [s] ≥ 0. @return  the time of the motion that goes by [s]
  double advance(double dt) noexcept;

  double rate() const noexcept;         // ρ
  double rate_change() const noexcept;  // ρ̇ [1/s]
  /// s runs as t does.
  bool is_real_time() const noexcept { return elapsed_ >= over_ && to_ == 1.0; }

 private:
  double motion_time(double elapsed) const noexcept;

  double from_ = 1.0, to_ = 1.0;
  double over_ = 0.0;     // [s]
  double elapsed_ = 0.0;  // [s] since the rate began to move
};

}  // namespace seam
