#include "scenes/springs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace seam {

namespace {

constexpr double window = 0.2;  // [s] after a join

std::vector<int> elastic(const RobotModel& model) {
  std::vector<int> joints;
  for (int i = 0; i < model.dof(); ++i)
    if (model.joints[static_cast<std::size_t>(i)].is_elastic()) joints.push_back(i);
  return joints;
}

// [Hz] of the slowest joint; rotors of elastic joints are on the other side of their springs.
double slowest_resonance(const RobotModel& model, const InverseDynamics& dynamics,
                         const Eigen::VectorXd& q) {
  const int n = model.dof();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd h(n);
  Eigen::MatrixXd M(n, n);
  dynamics.torque(q, rest, rest, h);
  for (int i = 0; i < n; ++i) dynamics.torque(q, rest, Eigen::VectorXd::Unit(n, i), M.col(i));
  M.colwise() -= h;
  for (int i = 0; i < n; ++i) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    if (!joint.is_elastic()) M(i, i) += joint.rotor_inertia;
  }
  const Eigen::VectorXd W = M.inverse().diagonal();
  double slowest = std::numeric_limits<double>::infinity();
  for (const int i : elastic(model)) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    slowest = std::min(slowest, std::sqrt(joint.stiffness * (1.0 / joint.rotor_inertia + W(i))));
  }
  return slowest / (2.0 * M_PI);
}

// Half of the widest swing about the parabola that fits best.
double swing(const Eigen::VectorXd& values) {
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(values.size(), -1.0, 1.0);
  Eigen::MatrixXd powers(values.size(), 3);
  powers << Eigen::VectorXd::Ones(values.size()), s, s.cwiseAbs2();
  const Eigen::VectorXd left = values - powers * powers.householderQr().solve(values);
  return 0.5 * (left.maxCoeff() - left.minCoeff());
}

}  // namespace

Springs::Springs(const Robot& robot, int ticks)
    : robot_(robot), dynamics_(robot.model()), joints_(elastic(robot.model())) {
  dynamics_.set_gravity(robot.gravity_in_base());
  beyond_.setZero(ticks, static_cast<Eigen::Index>(joints_.size()));
  q_ = qd_ = theta_ = w_ = qdd_ = needed_ = Eigen::VectorXd::Zero(robot.dof());
  robot_.state(q_, qd_);
  resonance_ = slowest_resonance(robot.model(), dynamics_, q_);
}

void Springs::look(Eigen::Index tick) noexcept {
  robot_.state(q_, qd_);
  robot_.motor_state(theta_, w_);
  for (std::size_t a = 0; a < joints_.size(); ++a) {
    const int i = joints_[a];
    const Joint& joint = robot_.model().joints[static_cast<std::size_t>(i)];
    beyond_(tick, static_cast<Eigen::Index>(a)) =
        joint.stiffness * (theta_(i) - q_(i)) + joint.spring_damping * (w_(i) - qd_(i));
  }
}

void Springs::compare(Eigen::Index tick, const Sample& reference) noexcept {
  const Eigen::Index n = reference.position.size();
  q_.head(n) = reference.position;
  qd_.head(n) = reference.velocity;
  qdd_.head(n) = reference.acceleration;
  dynamics_.torque(q_, qd_, qdd_, needed_);
  for (std::size_t a = 0; a < joints_.size(); ++a)
    beyond_(tick, static_cast<Eigen::Index>(a)) -= needed_(joints_[a]);
}

void Springs::finish(Recording& recording) const {
  double widest = 0.0;
  const double dt = recording.dt();
  const auto ticks = static_cast<Eigen::Index>(std::lround(window / dt));
  for (const RecordedJoin& join : recording.joins) {
    const auto first = static_cast<Eigen::Index>(std::ceil(join.time / dt - 1e-6));
    if (first + ticks > recording.ticks()) continue;
    for (Eigen::Index a = 0; a < beyond_.cols(); ++a)
      widest = std::max(widest, swing(beyond_.col(a).segment(first, ticks)));
  }
  recording.outcomes.push_back({"ringing_nm", widest});
  recording.outcomes.push_back({"resonance_hz", resonance_});
}

}  // namespace seam
