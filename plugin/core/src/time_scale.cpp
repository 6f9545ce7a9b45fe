#include <algorithm>
#include <cmath>

#include <seam/time_scale.hpp>

namespace seam {

namespace {

// Quintics in u that begin with (value, slope, curvature) of (1, 0, 0), (0, 1, 0), (0, 0, 1) and end with (0, 0, 0).
double value_part(double u) {
  return 1.0 - u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}
double slope_part(double u) {
  return u * (1.0 + u * u * (-6.0 + u * (8.0 - 3.0 * u)));
}
double curvature_part(double u) {
  return 0.5 * u * u * (1.0 - u) * (1.0 - u) * (1.0 - u);
}

}  // namespace

bool TimeScale::change(double rate, double over) noexcept {
  if (!(std::isfinite(rate) && rate >= 0.0 && over >= 1e-6 && over <= 1e6)) return false;
  const double now = this->rate();
  const double slope = rate_change();
  const double curvature = rate_curvature();
  from_ = now;
  slope_ = slope;
  curvature_ = curvature;
  to_ = rate;
  elapsed_ = 0.0;
  for (over_ = over; !never_negative(); over_ *= 0.5) {
  }
  return true;
}

// At 64 instants; a ramp from a falling rate that is too long for it would run the motion backwards.
bool TimeScale::never_negative() const noexcept {
  for (int i = 1; i < 64; ++i)
    if (rate_at(i / 64.0) < -1e-12) return false;
  return true;
}

double TimeScale::advance(double dt) noexcept {
  if (elapsed_ >= over_) return to_ * dt;
  const double before = motion_time(elapsed_);
  elapsed_ += dt;
  return std::max(0.0, motion_time(elapsed_) - before);
}

// Since the rate began to move: the integral of rate_at.
double TimeScale::motion_time(double elapsed) const noexcept {
  const double u = std::min(elapsed / over_, 1.0);
  const double u2 = u * u;
  const double u3 = u2 * u;
  const double value = u - u2 * u2 * (2.5 + u * (-3.0 + u));
  const double slope = u2 * (0.5 + u2 * (-1.5 + u * (1.6 - 0.5 * u)));
  const double curvature = 0.5 * u3 * (1.0 / 3.0 + u * (-0.75 + u * (0.6 - u / 6.0)));
  return to_ * elapsed + over_ * ((from_ - to_) * value +
                                  over_ * (slope_ * slope + over_ * curvature_ * curvature));
}

double TimeScale::rate_at(double u) const noexcept {
  return to_ + (from_ - to_) * value_part(u) +
         over_ * (slope_ * slope_part(u) + over_ * curvature_ * curvature_part(u));
}

double TimeScale::rate() const noexcept {
  return elapsed_ >= over_ ? to_ : rate_at(elapsed_ / over_);
}

double TimeScale::rate_change() const noexcept {
  if (elapsed_ >= over_) return 0.0;
  const double u = elapsed_ / over_;
  const double value = -30.0 * u * u * (1.0 - u) * (1.0 - u);
  const double slope = 1.0 + u * u * (-18.0 + u * (32.0 - 15.0 * u));
  const double curvature = 0.5 * u * (1.0 - u) * (1.0 - u) * (2.0 - 5.0 * u);
  return (from_ - to_) / over_ * value + slope_ * slope + over_ * curvature_ * curvature;
}

double TimeScale::rate_curvature() const noexcept {
  if (elapsed_ >= over_) return 0.0;
  const double u = elapsed_ / over_;
  const double value = -60.0 * u * (1.0 - u) * (1.0 - 2.0 * u);
  const double slope = u * (-36.0 + u * (96.0 - 60.0 * u));
  const double curvature = 1.0 + u * (-9.0 + u * (18.0 - 10.0 * u));
  return (from_ - to_) / (over_ * over_) * value + slope_ / over_ * slope + curvature_ * curvature;
}

}  // namespace seam
