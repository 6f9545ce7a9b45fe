#include <seam/fading_offset.hpp>

namespace seam {

namespace {

constexpr double negligible = 1e-12;  // [rad or m, per s]

}  // namespace

void FadingOffset::start(const Eigen::VectorXd& position,
                         const Eigen::VectorXd& velocity) noexcept {
  position_ = position;
  velocity_ = velocity;
  const bool nothing = position_.isZero(negligible) && velocity_.isZero(negligible);
  time_ = nothing ? duration : 0.0;
}

void FadingOffset::advance(double dt) noexcept {
  if (!faded()) time_ += dt;
}

void FadingOffset::add_to(Sample& reference) const noexcept {
  if (faded()) return;
  constexpr double T = duration;
  const double s = time_ / T;
  const double s2 = s * s, s3 = s2 * s;
  const double a = 1.0 - s3 * (10.0 + s * (-15.0 + 6.0 * s));
  const double a1 = -30.0 * s2 * (1.0 - s) * (1.0 - s) / T;
  const double a2 = -60.0 * s * (1.0 + s * (-3.0 + 2.0 * s)) / (T * T);
  const double b = T * (s + s3 * (-6.0 + s * (8.0 - 3.0 * s)));
  const double b1 = 1.0 + s2 * (-18.0 + s * (32.0 - 15.0 * s));
  const double b2 = s * (-36.0 + s * (96.0 - 60.0 * s)) / T;
  reference.position += a * position_ + b * velocity_;
  reference.velocity += a1 * position_ + b1 * velocity_;
  reference.acceleration += a2 * position_ + b2 * velocity_;
}

}  // namespace seam
