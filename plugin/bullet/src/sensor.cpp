#include <algorithm>
#include <cmath>

#include "settings_check.hpp"
#include <seam/error.hpp>
#include <seam/sensor.hpp>

namespace seam {

Sensor::Sensor(const RobotModel& model, const SensorSettings& settings)
    : delay_(settings.delay),
      resolution_(not_negative("sensor: resolution", settings.resolution, model.dof())),
      position_noise_(not_negative("sensor: position noise", settings.position_noise, model.dof())),
      velocity_noise_(not_negative("sensor: velocity noise", settings.velocity_noise, model.dof())),
      noise_(settings.seed),
      q_(Eigen::VectorXd::Zero(model.dof())),
      qd_(q_) {
  if (!(std::isfinite(delay_) && delay_ >= 0.0))
    throw Error("sensor: delay", std::to_string(delay_) + " s, must be >= 0");
  ideal_ = delay_ == 0.0 && resolution_.isZero(0.0) && position_noise_.isZero(0.0) &&
           velocity_noise_.isZero(0.0);
  if (delay_ > 0.0) past_.assign(most_ticks, {0.0, q_, qd_});
}

const Sensor::Seen& Sensor::seen(int ticks_ago) const noexcept {
  return past_[static_cast<std::size_t>((latest_ - ticks_ago + most_ticks) % most_ticks)];
}

void Sensor::look_back(double time) noexcept {
  int ago = 0;
  while (ago + 1 < count_ && seen(ago).time > time) ++ago;
  const Seen& before = seen(ago);
  q_ = before.q;
  qd_ = before.qd;
  if (ago == 0 || before.time >= time) return;
  const Seen& after = seen(ago - 1);
  const double share = (time - before.time) / (after.time - before.time);
  q_ += share * (after.q - before.q);
  qd_ += share * (after.qd - before.qd);
}

void Sensor::measure(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd) noexcept {
  if (past_.empty()) {
    q_ = q;
    qd_ = qd;
  } else {
    latest_ = (latest_ + 1) % most_ticks;
    count_ = std::min(count_ + 1, most_ticks);
    Seen& now = past_[static_cast<std::size_t>(latest_)];
    now.time = time_;
    now.q = q;
    now.qd = qd;
    look_back(time_ - delay_);
    time_ += dt;
  }
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    if (position_noise_(i) > 0.0) q_(i) += position_noise_(i) * noise_.normal();
    if (velocity_noise_(i) > 0.0) qd_(i) += velocity_noise_(i) * noise_.normal();
    if (resolution_(i) > 0.0) q_(i) = resolution_(i) * std::round(q_(i) / resolution_(i));
  }
}

}  // namespace seam
