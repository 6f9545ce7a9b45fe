#include <algorithm>
#include <cmath>
#include <limits>

#include "settings_check.hpp"
#include <seam/error.hpp>
#include <seam/sensor.hpp>

namespace seam {

namespace {

constexpr double same_time = 1e-9;  // [s]

}  // namespace

Sensor::Sensor(const RobotModel& model, const SensorSettings& settings)
    : delay_(settings.delay),
      resolution_(not_negative("sensor: resolution", settings.resolution, model.dof())),
      position_noise_(not_negative("sensor: position noise", settings.position_noise, model.dof())),
      velocity_noise_(not_negative("sensor: velocity noise", settings.velocity_noise, model.dof())),
      dropouts_(settings.dropouts),
      noise_(settings.seed),
      q_(Eigen::VectorXd::Zero(model.dof())),
      qd_(q_) {
  if (!(std::isfinite(delay_) && delay_ >= 0.0))
    throw Error("sensor: delay", std::to_string(delay_) + " s, must be >= 0");
  for (const Dropout& dropout : dropouts_)
    if (!(std::isfinite(dropout.to) && dropout.from >= 0.0 && dropout.to > dropout.from))
      throw Error("sensor: dropout", "from " + std::to_string(dropout.from) + " s to " +
                                         std::to_string(dropout.to) +
                                         " s, must end after it began, at 0 or later");
  ideal_ = dropouts_.empty() && delay_ == 0.0 && resolution_.isZero(0.0) &&
           position_noise_.isZero(0.0) && velocity_noise_.isZero(0.0);
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

void Sensor::remember(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) noexcept {
  latest_ = (latest_ + 1) % most_ticks;
  count_ = std::min(count_ + 1, most_ticks);
  Seen& now = past_[static_cast<std::size_t>(latest_)];
  now.time = time_;
  now.q = q;
  now.qd = qd;
}

void Sensor::disturb() noexcept {
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    if (position_noise_(i) > 0.0) q_(i) += position_noise_(i) * noise_.normal();
    if (velocity_noise_(i) > 0.0) qd_(i) += velocity_noise_(i) * noise_.normal();
    if (resolution_(i) > 0.0) q_(i) = resolution_(i) * std::round(q_(i) / resolution_(i));
  }
}

const Dropout* Sensor::dropout() const noexcept {
  const auto now = std::find_if(dropouts_.begin(), dropouts_.end(), [this](const Dropout& dropout) {
    return dropout.from - same_time <= time_ && time_ < dropout.to - same_time;
  });
  return now == dropouts_.end() ? nullptr : &*now;
}

void Sensor::measure(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd) noexcept {
  if (!past_.empty()) remember(q, qd);
  const Dropout* lost = dropout();
  if (lost && lost->what == Dropout::What::missing) {
    q_.setConstant(std::numeric_limits<double>::quiet_NaN());
    qd_ = q_;
  } else if (!lost || time_ == 0.0) {
    if (past_.empty()) {
      q_ = q;
      qd_ = qd;
    } else {
      look_back(time_ - delay_);
    }
    disturb();
  }
  time_ += dt;
}

}  // namespace seam
