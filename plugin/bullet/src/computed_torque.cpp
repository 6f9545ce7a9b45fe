#include <utility>

#include <seam/computed_torque.hpp>

namespace seam {

ComputedTorque::ComputedTorque(InverseDynamics dynamics, const ControlSettings& settings)
    : dynamics_(std::move(dynamics)), settings_(settings) {
  matched_velocity_.setZero(dynamics_.dof());
  next_velocity_ = acceleration_ = matched_velocity_;
}

void ComputedTorque::torque(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                            const Sample& now, const Eigen::VectorXd& next,
                            Eigen::VectorXd& torque) noexcept {
  next_velocity_ = (next - now.position) / dt;
  if (settings_.reference == ControlSettings::Reference::matched)
    acceleration_ =
        (next_velocity_ - matched_velocity_) / dt + settings_.Kd * (matched_velocity_ - qd);
  else
    acceleration_ = now.acceleration + settings_.Kd * (now.velocity - qd);
  acceleration_ += settings_.Kp * (now.position - q);
  matched_velocity_.swap(next_velocity_);
  dynamics_.torque(q, qd, acceleration_, torque);
}

}  // namespace seam
