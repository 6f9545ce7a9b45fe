#include <cmath>

#include "text.hpp"
#include <seam/disturbance_observer.hpp>
#include <seam/error.hpp>

namespace seam {

DisturbanceObserver::DisturbanceObserver(double bandwidth, const Eigen::VectorXd& most)
    : bandwidth_(bandwidth),
      most_(most),
      correction_(Eigen::VectorXd::Zero(most.size())),
      qd_(correction_) {
  if (!(std::isfinite(bandwidth) && bandwidth >= 0.0))
    throw Error("controller", text("observer ", bandwidth, " rad/s, must be >= 0"));
}

void DisturbanceObserver::reset() noexcept {
  correction_.setZero();
  before_ = false;
}

void DisturbanceObserver::observe(double dt, const Eigen::VectorXd& asked,
                                  const Eigen::VectorXd& qd) noexcept {
  if (before_) {
    const double share = -std::expm1(-bandwidth_ * dt);
    correction_ += share * (asked - (qd - qd_) / dt - correction_);
    correction_ = correction_.cwiseMax(-most_).cwiseMin(most_);
  }
  qd_ = qd;
  before_ = true;
}

}  // namespace seam
