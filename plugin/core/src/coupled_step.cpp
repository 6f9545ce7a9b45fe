#include <seam/execution.hpp>

namespace seam {

namespace {

constexpr int sweeps = 3;              // each lifts the order of the predicted state by one
constexpr double rate_spacing = 1e-5;  // [s] of the difference that gives Ċ

// The forcing at the start, the middle and the end of the first half of a step, from those of the whole.
Eigen::Matrix3d nodes_of_first_half() {
  Eigen::Matrix3d nodes;
  nodes << 1.0, 0.0, 0.0,   //
      0.375, 0.75, -0.125,  //
      0.0, 1.0, 0.0;
  return nodes;
}

}  // namespace

void Execution::couple(std::shared_ptr<const Coupling> coupling, double time) {
  const int D = dimensions();
  if (coupled_.coupling) at(f_start).head(D) -= tau_ * tau_ * coupled_.value;
  coupled_.coupling = std::move(coupling);
  coupled_.time = time;
  dt_ = std::numeric_limits<double>::quiet_NaN();
  if (coupled_.coupling) {
    for (Eigen::VectorXd* values : {&coupled_.position, &coupled_.velocity, &coupled_.value,
                                    &coupled_.rate, &coupled_.middle, &coupled_.end})
      values->setZero(D);
    coupled_.uncoupled.setZero(D, 2);
    measure_coupling(sample_);
    at(f_start).head(D) += tau_ * tau_ * coupled_.value;
  }
  refresh_sample();
}

void Execution::evaluate_coupling(double time, Eigen::VectorXd& value) noexcept {
  value.setZero();
  coupled_.coupling->add(coupled_.position, coupled_.velocity, time, value);
}

void Execution::measure_coupling(const Sample& at) noexcept {
  if (!coupled_.coupling) return;
  coupled_.position = at.position;
  coupled_.velocity = at.velocity;
  evaluate_coupling(coupled_.time, coupled_.value);
}

// Along the motion: a central difference.
void Execution::measure_coupling_rate(const Sample& at) noexcept {
  if (!coupled_.coupling) return;
  for (const double h : {-rate_spacing, rate_spacing}) {
    coupled_.position = at.position + h * at.velocity + (0.5 * h * h) * at.acceleration;
    coupled_.velocity = at.velocity + h * at.acceleration;
    evaluate_coupling(coupled_.time + h, h < 0.0 ? coupled_.middle : coupled_.end);
  }
  coupled_.rate = (coupled_.end - coupled_.middle) / (2.0 * rate_spacing);
}

void Execution::set_coupled_step(double dt) noexcept {
  if (!coupled_.coupling) return;
  static const Eigen::Matrix3d nodes = nodes_of_first_half();
  coupled_.half = Propagator(gains_, tau_, 0.5 * dt);
  coupled_.half.Gamma = (coupled_.half.Gamma * nodes).eval();
}

// The state to which the forcing of the step leads.
void Execution::look_ahead(const Propagator& by) noexcept {
  const int D = dimensions();
  const auto state = hot_.block<Eigen::Dynamic, 4>(0, offset, D, 4);
  const auto forcing = hot_.block<Eigen::Dynamic, 3>(0, f_start, D, 3);
  coupled_.position.noalias() = at(target).head(D) + state.lazyProduct(by.Phi.row(0).transpose()) +
                                forcing.lazyProduct(by.Gamma.row(0).transpose());
  coupled_.velocity.noalias() = state.lazyProduct(by.Phi.row(1).transpose()) +
                                forcing.lazyProduct(by.Gamma.row(1).transpose());
}

// Adds the coupling to the forcing at the middle and the end of a step.
void Execution::predict_coupling(double dt) noexcept {
  const int D = dimensions();
  const double tau2 = tau_ * tau_;
  coupled_.uncoupled = hot_.block<Eigen::Dynamic, 2>(0, f_middle, D, 2);
  at(f_middle).head(D) += tau2 * coupled_.value;
  at(f_end).head(D) += tau2 * coupled_.value;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    look_ahead(coupled_.half);
    evaluate_coupling(coupled_.time + 0.5 * dt, coupled_.middle);
    at(f_middle).head(D) = coupled_.uncoupled.col(0) + tau2 * coupled_.middle;
    look_ahead(propagator_);
    evaluate_coupling(coupled_.time + dt, coupled_.end);
    at(f_end).head(D) = coupled_.uncoupled.col(1) + tau2 * coupled_.end;
  }
}

// Where the step has led to.
void Execution::finish_coupling(double dt) noexcept {
  const int D = dimensions();
  coupled_.time += dt;
  coupled_.position = at(target).head(D) + at(offset).head(D);
  coupled_.velocity = at(velocity).head(D);
  evaluate_coupling(coupled_.time, coupled_.value);
  at(f_start).head(D) = coupled_.uncoupled.col(1) + tau_ * tau_ * coupled_.value;
}

}  // namespace seam
