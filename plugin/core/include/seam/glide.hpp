#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/quintic.hpp>

namespace SEAM_API seam {

/// A value that is sent elsewhere and gets there without a step, as a function of time. From p₀, ṗ₀, p̈₀ at t₀, also in
/// the midst of another move, it moves to p₁ in a time T and is at rest there:
///     p(t) = p₀ + B(t) + (p₁ − p₀ − B(t₀ + Tᵦ))·(10u³ − 15u⁴ + 6u⁵),   u = (t − t₀)/T
///     B(t) = Tᵦṗ₀(w − w³ + w⁴/2) + Tᵦ²p̈₀(w²/2 − 2w³/3 + w⁴/4),         w = min((t − t₀)/Tᵦ, 1)
/// B brings the present velocity to 0 in Tᵦ, the time that the move in progress still has, T at the most: as in TimeScale,
/// so that no velocity carries it far away. p, ṗ and p̈ are continuous. What is before t₀ stays as it was.
/// @tparam Value  a double, or an Eigen vector of fixed size
template <typename Value>
class Glide {
 public:
  /// Rests at a value.
  explicit Glide(const Value& at) : now_(resting(at)), before_(now_) {}

  /// Moves to a value, from a time [s] on and over a time [s]. A move that has not begun by then is dropped.
  /// False, and no change, unless all is finite and over is 1e-6 to 1e6 s.
  bool move(const Value& to, double from, double over) noexcept {
    if (!(over >= 1e-6 && over <= 1e6) || !std::isfinite(from) || !is_finite(to)) return false;
    const Move& active = at(from);
    const Value position = active.value(from);
    const Value velocity = active.rate(from);
    const Value acceleration = active.curvature(from);
    const double left = active.from + active.over - from;
    const double braking = left > 0.0 ? std::min(left, over) : over;
    before_ = active;
    now_ = {position, velocity, acceleration, to, from, over, braking};
    return true;
  }

  Value value(double time) const noexcept { return at(time).value(time); }          // p
  Value rate(double time) const noexcept { return at(time).rate(time); }            // ṗ
  Value curvature(double time) const noexcept { return at(time).curvature(time); }  // p̈
  const Value& target() const noexcept { return now_.to; }                          // p₁

 private:
  struct Move {
    Value start, velocity, acceleration, to;
    double from, over, braking;

    Value gap() const noexcept {
      return to - start - (0.5 * braking) * velocity - (braking * braking / 12.0) * acceleration;
    }
    double share(double time) const noexcept { return std::clamp((time - from) / over, 0.0, 1.0); }
    double braked(double time) const noexcept {
      return std::clamp((time - from) / braking, 0.0, 1.0);
    }
    Value value(double time) const noexcept {
      if (time - from >= over) return to;
      const double w = braked(time);
      return start + (braking * w * (1.0 + w * w * (-1.0 + 0.5 * w))) * velocity +
             (braking * braking * w * w * (0.5 + w * (-2.0 / 3.0 + 0.25 * w))) * acceleration +
             (1.0 - fade(share(time))) * gap();
    }
    Value rate(double time) const noexcept {
      const double w = braked(time);
      return (1.0 + w * w * (-3.0 + 2.0 * w)) * velocity +
             (braking * w * (1.0 - w) * (1.0 - w)) * acceleration -
             (fade_slope(share(time)) / over) * gap();
    }
    Value curvature(double time) const noexcept {
      const double w = braked(time);
      return (6.0 * w * (w - 1.0) / braking) * velocity +
             (1.0 + w * (-4.0 + 3.0 * w)) * acceleration -
             (fade_curvature(share(time)) / (over * over)) * gap();
    }
  };

  static Move resting(const Value& at) {
    const Value zero = 0.0 * at;
    return {at, zero, zero, at, 0.0, 1.0, 1.0};
  }
  static bool is_finite(const Value& value) noexcept {
    if constexpr (std::is_arithmetic_v<Value>)
      return std::isfinite(value);
    else
      return value.allFinite();
  }
  const Move& at(double time) const noexcept { return time >= now_.from ? now_ : before_; }

  Move now_, before_;
};

}  // namespace seam
