#include <cmath>
#include <limits>
#include <utility>

#include <seam/computed_torque.hpp>

namespace seam {

namespace {

constexpr double not_yet = std::numeric_limits<double>::quiet_NaN();

}  // namespace

// With λ·dt = −(h ± g): g is real where the error creeps, imaginary where it swings.
TickGains::TickGains(const ControlSettings& settings, double dt) noexcept {
  const double h = 0.5 * settings.Kd * dt;
  const double Kp_dt2 = settings.Kp * dt * dt;
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

ComputedTorque::ComputedTorque(InverseDynamics dynamics, const ControlSettings& settings)
    : dynamics_(std::move(dynamics)), settings_(settings), dt_(not_yet) {
  matched_velocity_.setZero(dynamics_.dof());
  next_velocity_ = acceleration_ = matched_velocity_;
}

void ComputedTorque::start(const Eigen::VectorXd& velocity) noexcept {
  matched_velocity_ = velocity;
  dt_ = not_yet;
}

// The acceleration without feedback; what comes back is the velocity that the reference has now.
const Eigen::VectorXd& ComputedTorque::plan(double dt, const Sample& now,
                                            const Eigen::VectorXd& next) noexcept {
  if (dt != dt_) {
    gains_ = TickGains(settings_, dt);
    if (!std::isnan(dt_)) matched_velocity_ += 0.5 * (dt_ - dt) * now.acceleration;
    dt_ = dt;
  }
  const double per_tick = 1.0 / dt;
  next_velocity_ = per_tick * (next - now.position);
  matched_velocity_.swap(next_velocity_);
  if (settings_.reference == ControlSettings::Reference::plain) {
    acceleration_ = now.acceleration;
    return now.velocity;
  }
  acceleration_ = per_tick * (matched_velocity_ - next_velocity_);
  return next_velocity_;
}

void ComputedTorque::torque(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                            const Sample& now, const Eigen::VectorXd& next,
                            Eigen::VectorXd& torque) noexcept {
  const Eigen::VectorXd& velocity = plan(dt, now, next);
  acceleration_ += gains_.Kd * (velocity - qd) + gains_.Kp * (now.position - q);
  dynamics_.torque(q, qd, acceleration_, torque);
}

void ComputedTorque::torque(double dt, const Sample& now, const Eigen::VectorXd& next,
                            Eigen::VectorXd& torque) noexcept {
  const Eigen::VectorXd& velocity = plan(dt, now, next);
  dynamics_.torque(now.position, velocity, acceleration_, torque);
}

}  // namespace seam
