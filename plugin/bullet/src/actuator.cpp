#include <algorithm>
#include <cmath>
#include <limits>

#include <seam/actuator.hpp>
#include <seam/error.hpp>

namespace seam {

Actuator::Actuator(const RobotModel& model, const ActuatorSettings& settings)
    : lag_(settings.lag), limit_(model.dof()), delivered_(Eigen::VectorXd::Zero(model.dof())) {
  if (!(std::isfinite(lag_) && lag_ >= 0.0))
    throw Error("actuator", "lag " + std::to_string(lag_) + " s, must be >= 0");
  for (int i = 0; i < model.dof(); ++i)
    limit_(i) = settings.limit_effort ? model.joints[static_cast<std::size_t>(i)].effort
                                      : std::numeric_limits<double>::infinity();
}

const Eigen::VectorXd& Actuator::deliver(double dt, const Eigen::VectorXd& commanded) noexcept {
  const double share = begun_ && lag_ > 0.0 ? -std::expm1(-dt / lag_) : 1.0;
  begun_ = true;
  for (Eigen::Index i = 0; i < delivered_.size(); ++i) {
    const double limited = std::min(std::max(commanded(i), -limit_(i)), limit_(i));
    delivered_(i) = share == 1.0 ? limited : delivered_(i) + share * (limited - delivered_(i));
  }
  return delivered_;
}

}  // namespace seam
