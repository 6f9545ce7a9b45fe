#include <cmath>

#include <seam/time_scale.hpp>

namespace seam {

bool TimeScale::change(double rate, double over) noexcept {
  if (!(std::isfinite(rate) && rate >= 0.0 && std::isfinite(over) && over > 0.0)) return false;
  from_ = this->rate();
  to_ = rate;
  over_ = over;
  elapsed_ = 0.0;
  return true;
}

double TimeScale::advance(double dt) noexcept {
  if (elapsed_ >= over_) return to_ * dt;
  const double before = motion_time(elapsed_);
  elapsed_ += dt;
  return motion_time(elapsed_) - before;
}

// Since the rate began to move.
double TimeScale::motion_time(double elapsed) const noexcept {
  if (elapsed >= over_) return 0.5 * (from_ + to_) * over_ + to_ * (elapsed - over_);
  const double u = elapsed / over_;
  const double blend = u * u * u * u * (2.5 + u * (-3.0 + u));
  return from_ * elapsed + (to_ - from_) * over_ * blend;
}

double TimeScale::rate() const noexcept {
  if (elapsed_ >= over_) return to_;
  const double u = elapsed_ / over_;
  return from_ + (to_ - from_) * u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

double TimeScale::rate_change() const noexcept {
  if (elapsed_ >= over_) return 0.0;
  const double u = elapsed_ / over_;
  return (to_ - from_) / over_ * 30.0 * u * u * (1.0 - u) * (1.0 - u);
}

}  // namespace seam
