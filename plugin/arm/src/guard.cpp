#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "settings_check.hpp"
#include "state_check.hpp"
#include <seam/error.hpp>
#include <seam/guard.hpp>

namespace seam {

namespace {

constexpr double at_rest = 1e-9;  // [rad/s or m/s]
constexpr double infinity = std::numeric_limits<double>::infinity();

void require_bound(const char* what, double value) {
  if (!(value >= 0.0)) throw Error(what, std::to_string(value) + ", must be >= 0");
}

double slack(const Joint& joint, double share) {
  const double range = joint.upper - joint.lower;
  return std::isinf(share) || std::isinf(range) ? infinity : share * range;
}

// At which the feedback asks for a share of the effort limit, too.
double lost_error(const Joint& joint, double most_error, double share, double stiffness) {
  const bool matters = share > 0.0 && stiffness > 0.0 && std::isfinite(joint.effort);
  return matters ? std::max(most_error, share * joint.effort / stiffness) : most_error;
}

const char* unit(const Joint& joint) {
  return joint.type == Joint::Type::prismatic ? " m" : " rad";
}

}  // namespace

std::string describe(const Incident& incident, const RobotModel& robot) {
  using Cause = Incident::Cause;
  std::ostringstream line;
  line.imbue(std::locale::classic());
  if (incident.cause == Cause::none) return "nothing has happened";
  if (incident.cause == Cause::no_state) {
    const bool bridged = incident.value <= incident.bound;
    line << "from " << incident.time << " s on there was no state of the joints for "
         << (bridged ? "" : "more than ") << (bridged ? incident.value : incident.bound) << " s"
         << (bridged ? ", which was bridged" : "");
    return line.str();
  }
  line << "at " << incident.time << " s ";
  if (incident.cause == Cause::unreachable) {
    line << "the sequence led where the tool cannot be";
  } else {
    const Joint& joint = robot.joints[static_cast<std::size_t>(incident.joint)];
    const char* what = incident.cause == Cause::deviation ? " was off its reference by "
                       : incident.cause == Cause::goal    ? " was given the goal "
                                                          : " was led to ";
    line << "joint \"" << joint.name << "\"" << what << incident.value << unit(joint);
  }
  if (incident.cause != Cause::unreachable) line << ", the bound is " << incident.bound;
  return line.str();
}

Guard::Guard(const RobotModel& model, const GuardSettings& settings, double delay,
             const Eigen::VectorXd& stiffness)
    : settings_(settings),
      most_error_(settings.most_error.each(model.dof())),
      lost_error_(model.dof()),
      least_(model.dof()),
      most_(model.dof()),
      seen_q_(Eigen::VectorXd::Zero(model.dof())),
      seen_qd_(seen_q_),
      reference_(seen_q_),
      lower_(model.dof()),
      upper_(model.dof()),
      slack_(model.dof()),
      delay_(delay) {
  require_bound("guard: least_effort", settings.least_effort);
  require_bound("guard: longest_dropout", settings.longest_dropout);
  require_bound("guard: frozen_beyond", settings.frozen_beyond);
  require_bound("guard: beyond_limits", settings.beyond_limits);
  require_one_each("guard: most_error", most_error_, model.dof());
  for (const double bound : most_error_) require_bound("guard: most_error", bound);
  for (Eigen::Index i = 0; i < lower_.size(); ++i) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    lost_error_(i) = lost_error(joint, most_error_(i), settings.least_effort,
                                stiffness.size() == 0 ? 0.0 : stiffness(i));
    lower_(i) = joint.lower;
    upper_(i) = joint.upper;
    slack_(i) = slack(joint, settings.beyond_limits);
  }
  least_ = lower_ - slack_;
  most_ = upper_ + slack_;
}

bool Guard::trusts(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                   const Eigen::VectorXd& reference) noexcept {
  watched_ += dt;
  const bool stands = begun_ && same(q, seen_q_) && same(qd, seen_qd_);
  const bool known = stands || (finite(q) && finite(qd));
  if (known && (!stands || watched_ < delay_ + 1.5 * dt)) {
    seen_q_ = q;
    seen_qd_ = qd;
    reference_ = reference;
    begun_ = true;
  }
  frozen_ = stands && (frozen_ || moved_beyond(reference));
  const bool trusted = known && !frozen_;
  dropout_ = trusted ? 0.0 : dropout_ + dt;
  return trusted;
}

// Further than a state may stay the same.
bool Guard::moved_beyond(const Eigen::VectorXd& reference) const noexcept {
  const bool rests = seen_qd_.lpNorm<Eigen::Infinity>() < at_rest;
  for (Eigen::Index i = 0; i < reference.size(); ++i)
    if (std::abs(reference(i) - reference_(i)) >
        std::max(settings_.frozen_beyond,
                 rests && std::isfinite(most_error_(i)) ? most_error_(i) : 0.0))
      return true;
  return false;
}

void Guard::restart(const Eigen::VectorXd& q) noexcept {
  begun_ = frozen_ = false;
  watched_ = dropout_ = 0.0;
  least_ = (lower_ - slack_).cwiseMin(q);
  most_ = (upper_ + slack_).cwiseMax(q);
}

Incident Guard::dropout() const noexcept {
  return {Incident::Cause::no_state, 0.0, -1, dropout_, settings_.longest_dropout};
}

Incident Guard::deviation(const Eigen::VectorXd& q, const Eigen::VectorXd& reference,
                          bool limited) const noexcept {
  const Eigen::VectorXd& most = limited ? most_error_ : lost_error_;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double error = std::abs(q(i) - reference(i));
    if (error > most(i))
      return {Incident::Cause::deviation, 0.0, static_cast<int>(i), error, most(i)};
  }
  return {};
}

Incident Guard::beyond_limits(const Eigen::VectorXd& position) const noexcept {
  for (Eigen::Index i = 0; i < position.size(); ++i) {
    const double value = position(i);
    if (!(value < least_(i) || value > most_(i))) continue;
    const double bound = value < lower_(i) ? lower_(i) : upper_(i);
    return {Incident::Cause::joint_limit, 0.0, static_cast<int>(i), value, bound};
  }
  return {};
}

void Guard::keep_within_limits(const Eigen::VectorXd& from, Eigen::VectorXd& to) const noexcept {
  to = to.cwiseMax(lower_.cwiseMin(from)).cwiseMin(upper_.cwiseMax(from));
}

}  // namespace seam
