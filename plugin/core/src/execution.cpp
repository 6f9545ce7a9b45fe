#include <seam/execution.hpp>

namespace seam {

namespace {

const Primitive& valid(const Primitive& primitive) {
  primitive.validate();
  return primitive;
}

}  // namespace

Execution::Execution(const Primitive& primitive)
    : gains_(valid(primitive).gains),
      tau_(primitive.tau),
      basis_(primitive.kernels, primitive.alpha),
      learned_weights_(primitive.weights),
      weights_(primitive.weights),
      goal_(primitive.goal),
      row_(basis_.count()),
      sample_(primitive.dimensions()) {
  for (Eigen::ArrayXd* state : {&offset_, &velocity_, &lag_, &f_start_, &f_middle_, &f_end_})
    state->setZero(primitive.dimensions());
  Sample start(primitive.dimensions());
  start.position = primitive.start_position;
  start.velocity = primitive.start_velocity;
  reinitialise(start, basis_.start_phase(), Join::dmp2);
}

void Execution::reinitialise(const Sample& at, double phase, Join method) noexcept {
  entry_phase_ = phase_ = phase;
  elapsed_ = 0.0;
  weights_ = learned_weights_;
  basis_.regressor(phase, row_);
  continue_from(at, method, gains_, tau_, goal_, row_, weights_, lag_);
  lag_ -= goal_.array();
  offset_ = (at.position - goal_).array();
  velocity_ = at.velocity.array();
  forcing(phase, f_start_);
  refresh_sample();
}

void Execution::step(double dt) noexcept {
  if (dt != dt_) set_step(dt);
  elapsed_ += dt;
  const double middle = basis_.advance(entry_phase_, elapsed_ - 0.5 * dt, tau_);
  phase_ = basis_.advance(entry_phase_, elapsed_, tau_);
  forcing(middle, f_middle_);
  forcing(phase_, f_end_);
  const auto& P = propagator_.Phi;
  const auto& G = propagator_.Gamma;
  for (Eigen::Index d = 0; d < offset_.size(); ++d) {
    const Eigen::Vector3d state(offset_(d), velocity_(d), lag_(d));
    const Eigen::Vector3d force(f_start_(d), f_middle_(d), f_end_(d));
    offset_(d) = P.row(0).dot(state) + G.row(0).dot(force);
    velocity_(d) = P.row(1).dot(state) + G.row(1).dot(force);
    lag_(d) = P(2, 2) * state(2);
  }
  f_start_.swap(f_end_);
  refresh_sample();
}

void Execution::set_step(double dt) noexcept {
  dt_ = dt;
  propagator_ = Propagator(gains_, tau_, dt);
}

void Execution::forcing(double phase, Eigen::ArrayXd& f) noexcept {
  basis_.regressor(phase, row_);
  for (Eigen::Index d = 0; d < f.size(); ++d) f(d) = (row_ * weights_.col(d).array()).sum();
}

void Execution::refresh_sample() noexcept {
  const double tau2 = tau_ * tau_;
  sample_.position.array() = goal_.array() + offset_;
  sample_.velocity.array() = velocity_;
  sample_.acceleration.array() =
      (gains_.K * (lag_ - offset_) - gains_.D * tau_ * velocity_ + f_start_) / tau2;
}

}  // namespace seam
