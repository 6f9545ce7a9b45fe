#include <algorithm>
#include <cmath>

#include "settings_check.hpp"
#include <seam/actuator.hpp>
#include <seam/error.hpp>

namespace seam {

namespace {

Eigen::VectorXd limits(const RobotModel& model, bool limit) {
  Eigen::VectorXd limits(model.dof());
  for (int i = 0; i < model.dof(); ++i)
    limits(i) = limit ? model.joints[static_cast<std::size_t>(i)].effort
                      : std::numeric_limits<double>::infinity();
  return limits;
}

double within(double value, double limit) {
  return std::min(std::max(value, -limit), limit);
}

}  // namespace

Actuator::Actuator(const RobotModel& model, const ActuatorSettings& settings)
    : quantum_(not_negative("actuator: quantum", settings.quantum, model.dof())),
      limit_(limits(model, settings.limit_effort)),
      rate_(settings.rate.each(model.dof())),
      lag_(not_negative("actuator: lag", settings.lag, model.dof())),
      driven_(Eigen::VectorXd::Zero(model.dof())),
      delivered_(driven_) {
  if (rate_.size() != model.dof() || !(rate_.array() > 0.0).all())
    throw Error("actuator: rate", "must be a number > 0 [N·m/s], or one for each joint");
  ideal_ = quantum_.isZero(0.0) && !settings.limit_effort && rate_.array().isInf().all() &&
           lag_.isZero(0.0);
}

const Eigen::VectorXd& Actuator::deliver(double dt, const Eigen::VectorXd& commanded) noexcept {
  if (ideal_) return commanded;
  limited_ = false;
  for (Eigen::Index i = 0; i < delivered_.size(); ++i) {
    const double step = quantum_(i);
    const double command = step > 0.0 ? step * std::round(commanded(i) / step) : commanded(i);
    const double wanted = within(command, limit_(i));
    const double change = wanted - driven_(i);
    const double most = rate_(i) * dt;
    limited_ |= wanted != command || (begun_ && std::abs(change) > most);
    driven_(i) = !begun_ || std::abs(change) <= most ? wanted : driven_(i) + within(change, most);
    delivered_(i) = begun_ && lag_(i) > 0.0
                        ? delivered_(i) - std::expm1(-dt / lag_(i)) * (driven_(i) - delivered_(i))
                        : driven_(i);
  }
  begun_ = true;
  return delivered_;
}

}  // namespace seam
