#include <cmath>
#include <limits>
#include <utility>

#include "driven_inertia.hpp"
#include "settings_check.hpp"
#include "text.hpp"
#include <seam/computed_torque.hpp>
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr double not_yet = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXd of_joints(const RobotModel& model, double Joint::*value) {
  Eigen::VectorXd values(model.dof());
  for (int i = 0; i < model.dof(); ++i)
    values(i) = model.joints[static_cast<std::size_t>(i)].*value;
  return values;
}

double positive(const char* what, double value) {
  if (!(std::isfinite(value) && value > 0.0))
    throw Error("controller", text(what, " ", value, ", must be > 0"));
  return value;
}

double checked(const char* what, double value) {
  if (!(std::isfinite(value) && value >= 0.0))
    throw Error("controller", text(what, " ", value, ", must be >= 0"));
  return value;
}

// What the observer may add: see ControlSettings::most_correction.
Eigen::VectorXd most_correction(const RobotModel& model, double share, const Eigen::VectorXd& Kp,
                                const Eigen::VectorXd& posture) {
  const Eigen::VectorXd inertia = driven_inertia(model, posture);
  Eigen::VectorXd most = share * Kp;
  for (int i = 0; i < model.dof(); ++i) {
    const double effort = model.joints[static_cast<std::size_t>(i)].effort;
    if (effort > 0.0 && std::isfinite(effort)) most(i) = share * effort / inertia(i);
  }
  return most;
}

}  // namespace

// With λ·dt = −(h ± g): g is real where the error creeps, imaginary where it swings.
TickGains::TickGains(double Kp_in_time, double Kd_in_time, double dt) noexcept {
  const double h = 0.5 * Kd_in_time * dt;
  const double Kp_dt2 = Kp_in_time * dt * dt;
  const double g2 = h * h - Kp_dt2;
  Kd = -std::expm1(-2.0 * h) / dt;
  if (g2 > 0.0) {
    const double fast = h + std::sqrt(g2);
    Kp = std::expm1(-fast) * std::expm1(-Kp_dt2 / fast) / (dt * dt);
  } else {
    const double swing = 2.0 * std::sin(0.5 * std::sqrt(-g2));
    const double fall = std::expm1(-h);
    Kp = (fall * fall + std::exp(-h) * swing * swing) / (dt * dt);
  }
}

ComputedTorque::ComputedTorque(const RobotModel& model, const ControlSettings& settings,
                               const Eigen::VectorXd& posture)
    : dynamics_(model),
      reference_(settings.reference),
      dt_(not_yet),
      Kp_(Eigen::VectorXd::Zero(model.dof())),
      Kd_(Kp_),
      matched_velocity_(Kp_),
      next_velocity_(Kp_),
      acceleration_(Kp_),
      per_friction_velocity_(1.0 / positive("friction_velocity", settings.friction_velocity)),
      rotors_(of_joints(model, &Joint::rotor_inertia)),
      viscous_(checked("friction_share", settings.friction_share) *
               of_joints(model, &Joint::damping)),
      coulomb_(settings.friction_share * of_joints(model, &Joint::friction)),
      observer_(
          settings.observer,
          most_correction(model, checked("most_correction", settings.most_correction),
                          not_negative("controller: gain Kp", settings.Kp, model.dof()), posture)),
      Kp_in_time_(settings.Kp.each(model.dof())),
      Kd_in_time_(not_negative("controller: gain Kd", settings.Kd, model.dof())) {
  has_drives_ = !(rotors_.isZero(0.0) && viscous_.isZero(0.0) && coulomb_.isZero(0.0));
}

void ComputedTorque::start(const Eigen::VectorXd& velocity) noexcept {
  matched_velocity_ = velocity;
  dt_ = not_yet;
  observer_.reset();
}

void ComputedTorque::set_gains(double dt) noexcept {
  TickGains gains(0.0, 0.0, dt);
  for (Eigen::Index i = 0; i < Kp_.size(); ++i) {
    const bool as_before =
        i > 0 && Kp_in_time_(i) == Kp_in_time_(i - 1) && Kd_in_time_(i) == Kd_in_time_(i - 1);
    if (!as_before) gains = TickGains(Kp_in_time_(i), Kd_in_time_(i), dt);
    Kp_(i) = gains.Kp;
    Kd_(i) = gains.Kd;
  }
}

// The acceleration without feedback; what comes back is the velocity that the reference has now.
const Eigen::VectorXd& ComputedTorque::plan(double dt, const Sample& now,
                                            const Eigen::VectorXd& next) noexcept {
  if (dt != dt_) {
    set_gains(dt);
    if (!std::isnan(dt_)) matched_velocity_ += 0.5 * (dt_ - dt) * now.acceleration;
    dt_ = dt;
  }
  const double per_tick = 1.0 / dt;
  next_velocity_ = per_tick * (next - now.position);
  matched_velocity_.swap(next_velocity_);
  if (reference_ == ControlSettings::Reference::plain) {
    acceleration_ = now.acceleration;
    return now.velocity;
  }
  acceleration_ = per_tick * (matched_velocity_ - next_velocity_);
  return next_velocity_;
}

void ComputedTorque::torque(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                            const Sample& now, const Eigen::VectorXd& next,
                            Eigen::VectorXd& torque) noexcept {
  if (observer_.observes()) observer_.observe(dt_, acceleration_, qd);
  const Eigen::VectorXd& velocity = plan(dt, now, next);
  acceleration_ += Kd_.cwiseProduct(velocity - qd) + Kp_.cwiseProduct(now.position - q);
  if (observer_.observes()) acceleration_ += observer_.correction();
  dynamics_.torque(q, qd, acceleration_, torque);
  if (has_drives_) add_drives(now, torque);
}

void ComputedTorque::torque(double dt, const Sample& now, const Eigen::VectorXd& next,
                            Eigen::VectorXd& torque) noexcept {
  const Eigen::VectorXd& velocity = plan(dt, now, next);
  if (observer_.observes()) {
    acceleration_ += observer_.correction();
    observer_.hold();
  }
  dynamics_.torque(now.position, velocity, acceleration_, torque);
  if (has_drives_) add_drives(now, torque);
}

// Rotors and friction.
void ComputedTorque::add_drives(const Sample& now, Eigen::VectorXd& torque) const noexcept {
  const Eigen::VectorXd& velocity =
      reference_ == ControlSettings::Reference::plain ? now.velocity : matched_velocity_;
  for (Eigen::Index i = 0; i < torque.size(); ++i) {
    torque(i) += rotors_(i) * acceleration_(i) + viscous_(i) * velocity(i);
    if (coulomb_(i) > 0.0)
      torque(i) += coulomb_(i) * std::tanh(velocity(i) * per_friction_velocity_);
  }
}

}  // namespace seam
