#include <seam/fading_offset.hpp>
#include <seam/quintic.hpp>

namespace seam {

namespace {

constexpr double negligible = 1e-12;  // [rad or m, per s, per s²]

}  // namespace

void FadingOffset::restart() noexcept {
  const bool nothing = start_.position.isZero(negligible) && start_.velocity.isZero(negligible) &&
                       start_.acceleration.isZero(negligible);
  time_ = nothing ? duration : 0.0;
}

void FadingOffset::start(const Eigen::VectorXd& position,
                         const Eigen::VectorXd& velocity) noexcept {
  start_.position = position;
  start_.velocity = velocity;
  start_.acceleration.setZero();
  restart();
}

void FadingOffset::shift(const Eigen::VectorXd& position,
                         const Eigen::VectorXd& velocity) noexcept {
  now_.position = position;
  now_.velocity = velocity;
  now_.acceleration.setZero();
  add_to(now_);
  start_.swap(now_);
  restart();
}

void FadingOffset::advance(double dt) noexcept {
  if (!faded()) time_ += dt;
}

void FadingOffset::add_to(Sample& reference) const noexcept {
  if (faded()) return;
  constexpr double T = duration;
  const double s = time_ / T;
  const double s2 = s * s, s3 = s2 * s;
  const double a = fade(s);
  const double a1 = fade_slope(s) / T;
  const double a2 = fade_curvature(s) / (T * T);
  const double b = T * (s + s3 * (-6.0 + s * (8.0 - 3.0 * s)));
  const double b1 = 1.0 + s2 * (-18.0 + s * (32.0 - 15.0 * s));
  const double b2 = s * (-36.0 + s * (96.0 - 60.0 * s)) / T;
  const double c = 0.5 * T * T * s2 * (1.0 + s * (-3.0 + s * (3.0 - s)));
  const double c1 = 0.5 * T * s * (2.0 + s * (-9.0 + s * (12.0 - 5.0 * s)));
  const double c2 = 1.0 + s * (-9.0 + s * (18.0 - 10.0 * s));
  reference.position += a * start_.position + b * start_.velocity + c * start_.acceleration;
  reference.velocity += a1 * start_.position + b1 * start_.velocity + c1 * start_.acceleration;
  reference.acceleration += a2 * start_.position + b2 * start_.velocity + c2 * start_.acceleration;
}

}  // namespace seam
