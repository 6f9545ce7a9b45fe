#include "drive_train.hpp"

#include <algorithm>
#include <cmath>

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "text.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr int base_dof = 6;  // that Bullet's vectors begin with

void require_valid(const Joint& joint) {
  const auto refuse = [&](const char* what, double value, const char* limit) {
    throw Error("joint \"" + joint.name + "\"", text(what, " ", value, ", must be ", limit));
  };
  const std::pair<const char*, double> values[] = {{"damping", joint.damping},
                                                   {"friction", joint.friction},
                                                   {"rotor inertia", joint.rotor_inertia},
                                                   {"spring damping", joint.spring_damping}};
  for (const auto& [what, value] : values)
    if (!(std::isfinite(value) && value >= 0.0)) refuse(what, value, "finite and >= 0");
  if (!(joint.stiffness > 0.0)) refuse("stiffness", joint.stiffness, "> 0");
  if (joint.is_elastic() && joint.rotor_inertia == 0.0)
    refuse("rotor inertia", 0.0, "> 0, since the joint is elastic");
}

std::vector<int> with_any(const RobotModel& model) {
  std::vector<int> joints;
  for (int i = 0; i < model.dof(); ++i) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    require_valid(joint);
    if (joint.damping > 0.0 || joint.friction > 0.0 || joint.rotor_inertia > 0.0)
      joints.push_back(i);
  }
  return joints;
}

}  // namespace

DriveTrain::DriveTrain(const RobotModel& model, btMultiBody& multibody)
    : multibody_(multibody), joints_(with_any(model)), factors_(size()), stick_slip_(size()) {
  const Eigen::Index m = size();
  if (m == 0) return;
  for (Eigen::VectorXd* values :
       {&J_, &b_, &c_, &k_, &d_, &theta_, &w_, &qd_, &qdd_, &spring_, &kappa_, &free_, &r_, &t_})
    values->setZero(m);
  for (Eigen::MatrixXd* matrix : {&W_, &P_, &A_}) matrix->setZero(m, m);
  for (Eigen::Index a = 0; a < m; ++a) {
    const Joint& joint =
        model.joints[static_cast<std::size_t>(joints_[static_cast<std::size_t>(a)])];
    J_(a) = joint.rotor_inertia;
    b_(a) = joint.damping;
    c_(a) = joint.friction;
    k_(a) = joint.stiffness;
    d_(a) = joint.spring_damping;
  }
  force_.resize(static_cast<std::size_t>(base_dof + model.dof()));
  response_ = force_;
  ask_bullet();  // which makes room in the scratch memory
}

void DriveTrain::reset(const Eigen::VectorXd& torque) {
  for (std::size_t a = 0; a < joints_.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    theta_(i) = multibody_.getJointPos(joints_[a]) + torque(joints_[a]) / k_(i);
    w_(i) = multibody_.getJointVel(joints_[a]);
  }
}

void DriveTrain::state_of_drives(Eigen::Ref<Eigen::VectorXd> q,
                                 Eigen::Ref<Eigen::VectorXd> qd) const noexcept {
  for (std::size_t a = 0; a < joints_.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    if (joints_[a] >= q.size() || std::isinf(k_(i))) continue;
    q(joints_[a]) = theta_(i);
    qd(joints_[a]) = w_(i);
  }
}

// Velocities, accelerations without the drives, and W. A step of no duration leaves Bullet's velocities as they are.
void DriveTrain::ask_bullet() noexcept {
  multibody_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, scratch_r_, scratch_v_,
                                                                  scratch_m_, false, false, false);
  const int accelerations = multibody_.getNumDofs() + base_dof;
  for (std::size_t a = 0; a < joints_.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    qd_(i) = multibody_.getJointVel(joints_[a]);
    qdd_(i) = scratch_r_[accelerations + joints_[a]];
  }
  std::fill(force_.begin(), force_.end(), btScalar(0));
  for (std::size_t a = 0; a < joints_.size(); ++a) {
    btScalar& unit = force_[static_cast<std::size_t>(base_dof + joints_[a])];
    unit = 1;
    multibody_.calcAccelerationDeltasMultiDof(force_.data(), response_.data(), scratch_r_,
                                              scratch_v_);
    unit = 0;
    for (std::size_t row = 0; row < joints_.size(); ++row)
      W_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(a)) =
          response_[static_cast<std::size_t>(base_dof + joints_[row])];
  }
}

// t = spring + P(w⁺ − free), where P = (dt·W + 1/κ)⁻¹; written so that a rigid joint (1/κ = 0) and a lossless spring (κ = 0) are no
// cases of their own.
void DriveTrain::couple(double dt) noexcept {
  for (Eigen::Index i = 0; i < k_.size(); ++i) {
    const bool rigid = std::isinf(k_(i));
    const double bound = 2.0 / (dt * dt * (1.0 / J_(i) + W_.row(i).cwiseAbs().sum()));
    const double position = multibody_.getJointPos(joints_[static_cast<std::size_t>(i)]);
    spring_(i) = rigid ? 0.0 : k_(i) * (theta_(i) - position);
    kappa_(i) = rigid ? 1.0 : 0.5 * dt * std::max(k_(i) - bound, 0.0) + d_(i);
    if (rigid) w_(i) = qd_(i);
  }
  t_ = kappa_.cwiseSqrt();
  for (Eigen::Index i = 0; i < k_.size(); ++i) A_.col(i) = dt * t_(i) * W_.col(i).cwiseProduct(t_);
  for (Eigen::Index i = 0; i < k_.size(); ++i)
    if (!std::isinf(k_(i)) || A_(i, i) == 0.0) A_(i, i) += 1.0;
  factors_.compute(A_);
  P_.setIdentity();
  for (Eigen::Index i = 0; i < k_.size(); ++i) {  // of a whole matrix Eigen would allocate
    auto column = P_.col(i);
    factors_.solveInPlace(column);
  }
  for (Eigen::Index i = 0; i < k_.size(); ++i) P_.col(i) = t_(i) * P_.col(i).cwiseProduct(t_);
}

void DriveTrain::transmit(double dt, Eigen::VectorXd& torque) noexcept {
  ask_bullet();
  couple(dt);
  free_ = qd_ + dt * qdd_;
  free_.noalias() += dt * W_ * spring_;
  A_ = P_;
  A_.diagonal() += J_ / dt + b_;
  r_ = (J_ / dt).cwiseProduct(w_) - spring_;
  r_.noalias() += P_ * free_;
  for (std::size_t a = 0; a < joints_.size(); ++a)
    r_(static_cast<Eigen::Index>(a)) += torque(joints_[a]);
  stick_slip_.solve(A_, r_, c_, w_);
  free_ = w_ - free_;
  t_ = spring_;
  t_.noalias() += P_ * free_;
  theta_ += dt * w_;
  for (std::size_t a = 0; a < joints_.size(); ++a)
    torque(joints_[a]) = t_(static_cast<Eigen::Index>(a));
}

}  // namespace seam
