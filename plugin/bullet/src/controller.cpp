#include <algorithm>
#include <cmath>

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <seam/controller.hpp>
#include <seam/error.hpp>
#include <seam/plugin.hpp>

namespace seam {

namespace {

constexpr double brake_tau = 0.5;  // [s]
// Three time constants of the triple pole, so that no joint turns back [s].
const double stopping_time = 3.0 * brake_tau / Gains().H;

const RobotModel& known(const Robot& robot, const ControllerSettings& settings) {
  const RobotModel& all = robot.model();
  if (!settings.model) return all;
  const auto& joints = settings.model->joints;
  const auto same = [](const Joint& a, const Joint& b) { return a.name == b.name; };
  if (joints.size() > all.joints.size() ||
      !std::equal(joints.begin(), joints.end(), all.joints.begin(), same))
    throw Error("controller", "the joints of its model are not the robot's first ones");
  return *settings.model;
}

std::unique_ptr<JointReference> reference(const RobotModel& model, const Sequence& sequence,
                                          const std::optional<ToolSettings>& tool,
                                          const Eigen::VectorXd& q) {
  std::unique_ptr<JointReference> joints;
  if (tool)
    joints = std::make_unique<TaskSpace>(model, sequence, *tool, q);
  else
    joints = std::make_unique<JointSpace>(model, sequence.coordinates());
  for (const Sequence::Step& step : sequence.steps()) joints->require_reachable(step.primitive);
  return joints;
}

// Without forcing, for dmp3 to join any motion to rest.
Primitive rest_at(const Eigen::VectorXd& q) {
  Primitive rest;
  for (Eigen::Index i = 0; i < q.size(); ++i) rest.coordinates.push_back(std::to_string(i));
  rest.kernels = Kernels::even_in_time(2, 0.75, rest.alpha);
  rest.weights.setZero(2, q.size());
  rest.tau = brake_tau;
  rest.goal = rest.start_position = q;
  rest.start_velocity = rest.start_acceleration = Eigen::VectorXd::Zero(q.size());
  return rest;
}

Controller::Tick tick_at(const Robot& robot, int n) {
  Controller::Tick tick;
  tick.q = tick.qd = tick.torque = Eigen::VectorXd::Zero(n);
  robot.state(tick.q, tick.qd);
  tick.reference = Sample::at_rest(tick.q);
  return tick;
}

const ControlSettings& valid(const ControlSettings& settings) {
  for (const double gain : {settings.Kp, settings.Kd})
    if (!(std::isfinite(gain) && gain >= 0.0))
      throw Error("controller", "gain " + std::to_string(gain) + ", must be >= 0");
  return settings;
}

bool same_motion(const Sample& a, const Sample& b) {
  const auto same = [](const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    return (x - y).squaredNorm() == 0.0;
  };
  return same(a.position, b.position) && same(a.velocity, b.velocity) &&
         same(a.acceleration, b.acceleration);
}

// Moves nothing: see apply_torque.
constexpr double mark = 0.1234567890123;  // [N·m]

}  // namespace

Controller::Controller(Robot& robot, const Sequence& sequence, const JoinSettings& join,
                       const ControllerSettings& settings)
    : robot_(robot),
      tick_(tick_at(robot, known(robot, settings).dof())),
      joints_(reference(known(robot, settings), sequence, settings.tool, tick_.q)),
      sequencer_(sequence, join, joints_->measured(tick_.q, tick_.qd)),
      brake_(rest_at(tick_.q)),
      coming_to_rest_(tick_.q),
      law_(InverseDynamics(known(robot, settings)), valid(settings.law)),
      sensor_(known(robot, settings), settings.sensor),
      actuator_(known(robot, settings), settings.actuator),
      next_sequence_(sequencer_.sample()),
      next_(tick_.reference) {
  joints_->find(next_sequence_, next_);
  tick_.sequence = next_sequence_;
  tick_.reference = next_;
  law_.start(next_.velocity);
  applied_.setZero(tick_.q.size());
}

Controller::~Controller() {
  if (plugin_) plugin_->remove(*this);
}

void Controller::pre_tick(double dt) noexcept {
  if (!(dt > 0.0)) return;
  tick_.time = sequencer_.time();
  tick_.running = sequencer_.running();
  robot_.state(tick_.q, tick_.qd);
  tick_.sequence.swap(next_sequence_);
  tick_.reference.swap(next_);
  if (!same_motion(sequencer_.sample(), tick_.sequence)) {  // it was changed since the last tick
    tick_.sequence = sequencer_.sample();
    follow(tick_.sequence, tick_.reference);
  }
  tick_.tool_error = joints_->miss(tick_.sequence, tick_.q);
  sequencer_.step(dt);
  next_sequence_ = sequencer_.sample();
  follow(next_sequence_, next_);
  if (status_ == Status::stopped) {
    brake_.step(dt);
    next_ = brake_.sample();
  }
  law_.set_gravity(robot_.gravity_in_base());
  if (!sensor_.ideal()) sensor_.measure(dt, tick_.q, tick_.qd);
  law_.torque(dt, sensor_.ideal() ? tick_.q : sensor_.q(),
              sensor_.ideal() ? tick_.qd : sensor_.qd(), tick_.reference, next_.position,
              tick_.torque);
  apply_torque(actuator_.deliver(dt, tick_.torque));
}

// Where there is no reference any more the joints come to rest from the last one that there was.
void Controller::follow(const Sample& sequence, Sample& joints) noexcept {
  if (status_ == Status::stopped || joints_->find(sequence, joints)) return;
  status_ = Status::stopped;
  coming_to_rest_ = tick_.reference.position + stopping_time * tick_.reference.velocity;
  brake_.set_goal(coming_to_rest_);
  brake_.reinitialise(tick_.reference, 1.0, Join::dmp3);
}

// Bullet clears joint torques once per stepSimulation and not per substep. The base of a fixed-base
// multibody bears a torque that moves nothing and is cleared with them: if it is still what we left,
// our joint torques still stand too.
void Controller::apply_torque(const Eigen::VectorXd& torque) noexcept {
  btMultiBody& multibody = robot_.multibody();
  const bool still_stands = marked_ && multibody.getBaseTorque().x() == base_torque_;
  if (!still_stands) applied_.setZero();
  for (int i = 0; i < torque.size(); ++i)
    multibody.getLink(i).m_jointTorque[0] += static_cast<btScalar>(torque(i) - applied_(i));
  if (!still_stands) multibody.addBaseTorque(btVector3(btScalar(mark), 0, 0));
  applied_ = torque;
  base_torque_ = multibody.getBaseTorque().x();
  marked_ = true;
}

}  // namespace seam
