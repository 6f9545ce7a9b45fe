#include <algorithm>
#include <cmath>

#include <seam/quintic.hpp>
#include <seam/time_scale.hpp>

namespace seam {

namespace {

constexpr double most_beyond = 0.1;  // of the rate, or of 1
constexpr double most_lost = 0.5;    // of the rate

// Of fade(u), from 0 on.
double fade_integral(double u) {
  return u - u * u * u * u * (2.5 + u * (-3.0 + u));
}

// What remains of D until it is over, for ρ̇₀ = 1/Tᵦ and for ρ̈₀ = 1/Tᵦ²; likewise.
double slope_part(double w) {
  return w * (1.0 + w * w * (-1.0 + 0.5 * w)) - 0.5;
}
double slope_slope(double w) {
  return (1.0 - w) * (1.0 - w) * (1.0 + 2.0 * w);
}
double slope_curvature(double w) {
  return -6.0 * w * (1.0 - w);
}
double slope_integral(double w) {
  return w * (-0.5 + w * (0.5 + w * w * (-0.25 + 0.1 * w)));
}
double curvature_part(double w) {
  return w * w * (0.5 + w * (-2.0 / 3.0 + 0.25 * w)) - 1.0 / 12.0;
}
double curvature_slope(double w) {
  return w * (1.0 - w) * (1.0 - w);
}
double curvature_curvature(double w) {
  return (1.0 - w) * (1.0 - 3.0 * w);
}
double curvature_integral(double w) {
  return w * (-1.0 / 12.0 + w * w * (1.0 / 6.0 + w * (-1.0 / 6.0 + 0.05 * w)));
}

// The longest time in which what leads upwards of a slope and a curvature takes the rate up by no more than `room`:
// T·slope/2 + T²·curvature/12 = room.
double braking_time(double slope, double curvature, double room) {
  const double half = 0.5 * std::max(slope, 0.0);
  const double root = std::sqrt(half * half + std::max(curvature, 0.0) * room / 3.0);
  return half + root > 0.0 ? 2.0 * room / (half + root) : HUGE_VAL;
}

double share(double elapsed, double time) {
  return std::min(elapsed / time, 1.0);
}

}  // namespace

bool TimeScale::change(double rate, double over) noexcept {
  if (!(std::isfinite(rate) && rate >= 0.0 && over >= 1e-6 && over <= 1e6)) return false;
  const double now = this->rate();
  const double slope = rate_change();
  const double curvature = rate_curvature();
  const double beyond = most_beyond * std::max(1.0, now);
  const double room_above = std::max(rate - now, beyond);
  const double room_below = std::max(now - rate, std::min(beyond, most_lost * now));
  const double in_progress = elapsed_ < over_ ? over_ - elapsed_ : over;
  braking_ = std::min({over, in_progress, braking_time(slope, curvature, room_above),
                       braking_time(-slope, -curvature, room_below)});
  const bool brakes = braking_ > 0.0;
  if (!brakes) braking_ = over;
  slope_ = brakes ? slope : 0.0;
  curvature_ = brakes ? curvature : 0.0;
  to_ = rate;
  gap_ = now - rate + braking_ * (0.5 * slope_ + braking_ * curvature_ / 12.0);
  over_ = over;
  elapsed_ = 0.0;
  return true;
}

double TimeScale::advance(double dt) noexcept {
  if (elapsed_ >= over_) return to_ * dt;
  const double before = motion_time(elapsed_);
  elapsed_ += dt;
  return std::max(0.0, motion_time(elapsed_) - before);
}

// Since the rate began to move: the integral of the rate.
double TimeScale::motion_time(double elapsed) const noexcept {
  const double w = share(elapsed, braking_);
  return to_ * elapsed + over_ * gap_ * fade_integral(share(elapsed, over_)) +
         braking_ * braking_ *
             (slope_ * slope_integral(w) + braking_ * curvature_ * curvature_integral(w));
}

double TimeScale::rate() const noexcept {
  if (elapsed_ >= over_) return to_;
  const double w = share(elapsed_, braking_);
  const double braking = slope_ * slope_part(w) + braking_ * curvature_ * curvature_part(w);
  return std::max(0.0, to_ + gap_ * fade(elapsed_ / over_) + braking_ * braking);
}

double TimeScale::rate_change() const noexcept {
  if (elapsed_ >= over_) return 0.0;
  const double w = share(elapsed_, braking_);
  return gap_ / over_ * fade_slope(elapsed_ / over_) + slope_ * slope_slope(w) +
         braking_ * curvature_ * curvature_slope(w);
}

double TimeScale::rate_curvature() const noexcept {
  if (elapsed_ >= over_) return 0.0;
  const double w = share(elapsed_, braking_);
  return gap_ / (over_ * over_) * fade_curvature(elapsed_ / over_) +
         slope_ / braking_ * slope_curvature(w) + curvature_ * curvature_curvature(w);
}

}  // namespace seam
