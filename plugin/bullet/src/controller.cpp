#include <algorithm>
#include <cmath>
#include <limits>

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "state_check.hpp"
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
  return same(a.position, b.position) && same(a.velocity, b.velocity) &&
         same(a.acceleration, b.acceleration);
}

// Moves nothing: see apply_torque.
constexpr double mark = 0.1234567890123;  // [N·m]

}  // namespace

Controller::Claim::Claim(const Robot& robot) : controlled_(robot.controlled()) {
  if (*controlled_)
    throw Error(robot.model().name,
                "has a controller already, whose torques those of another would add to");
  *controlled_ = true;
}

Controller::Controller(Robot& robot, const Sequence& sequence, const JoinSettings& join,
                       const ControllerSettings& settings)
    : robot_(robot),
      claim_(robot),
      tick_(tick_at(robot, known(robot, settings).dof())),
      joints_(reference(known(robot, settings), sequence, settings.tool, tick_.q)),
      sequencer_(sequence, join, joints_->measured(tick_.q, tick_.qd)),
      brake_(rest_at(tick_.q)),
      coming_to_rest_(tick_.q),
      law_(InverseDynamics(known(robot, settings)), valid(settings.law)),
      sensor_(known(robot, settings), settings.sensor),
      guard_(known(robot, settings), settings.guard, settings.sensor.delay),
      actuator_(known(robot, settings), settings.actuator),
      followers_(known(robot, settings)),
      offset_(static_cast<int>(tick_.q.size())),
      taken_up_(sequencer_.sample()),
      next_sequence_(taken_up_),
      next_(tick_.reference),
      here_(tick_.reference),
      goal_(sequencer_.goal()),
      at_goal_(tick_.q) {
  here_.velocity = tick_.qd;
  begin_here();
  tick_.sequence = next_sequence_;
  tick_.reference = next_;
  applied_.setZero(tick_.q.size());
}

Controller::~Controller() {
  if (plugin_) plugin_->remove(*this);
}

// From what the sequence has the joints do now, and what they do: the difference fades.
void Controller::begin_here() noexcept {
  next_sequence_ = sequencer_.sample();
  joints_->find(next_sequence_, next_);
  law_.start(here_.velocity);
  guard_.restart(here_.position);
  here_.position -= next_.position;
  here_.velocity -= next_.velocity;
  offset_.start(here_.position, here_.velocity);
  offset_.add_to(next_);
  goal_.setConstant(std::numeric_limits<double>::quiet_NaN());  // to be looked at by the new bounds
}

bool Controller::reinitialise() noexcept {
  robot_.state(here_.position, here_.velocity);
  if (goal_beyond_limits().cause != Incident::Cause::none ||
      !finite(here_.position, here_.velocity) ||
      !joints_->take_up(here_.position, here_.velocity, taken_up_) ||
      !sequencer_.reinitialise(taken_up_))
    return false;
  begin_here();
  sensor_.forget();
  blind_ = false;
  status_ = Status::following;
  incident_ = {};
  return true;
}

void Controller::pre_tick(double dt) noexcept {
  if (!(dt > 0.0)) return;
  begin_tick();
  const bool there = measure(dt);
  watch(there);
  plan(dt);
  command(dt, there);
}

void Controller::begin_tick() noexcept {
  tick_.time = sequencer_.time();
  tick_.running = sequencer_.running();
  robot_.state(tick_.q, tick_.qd);
  tick_.sequence.swap(next_sequence_);
  tick_.reference.swap(next_);
  look_at_goal();
  if (!same_motion(sequencer_.sample(), tick_.sequence)) {  // it was changed since the last tick
    tick_.sequence = sequencer_.sample();
    follow(tick_.sequence, tick_.reference);
  }
  tick_.tool_error = joints_->miss(tick_.sequence, tick_.q);
}

bool Controller::measure(double dt) noexcept {
  if (!sensor_.ideal()) sensor_.measure(dt, tick_.q, tick_.qd);
  return guard_.trusts(dt, q(), qd(), tick_.reference.position);
}

void Controller::watch(bool there) noexcept {
  if (!there) return bridge();
  if (blind_) regain();
  blind_ = false;
  const Incident off = guard_.deviation(q(), tick_.reference.position);
  if (off.cause != Incident::Cause::none) stop_here(off);
}

// Before what it makes of the motion is taken over.
void Controller::look_at_goal() noexcept {
  if (status_ == Status::stopped || same(goal_, sequencer_.goal())) return;
  goal_ = sequencer_.goal();
  const Incident beyond = goal_beyond_limits();
  if (beyond.cause != Incident::Cause::none) stop(beyond);
}

Incident Controller::goal_beyond_limits() noexcept {
  if (!joints_->at_goal(sequencer_.goal(), at_goal_)) return {};
  Incident beyond = guard_.beyond_limits(at_goal_);
  if (beyond.cause != Incident::Cause::none) beyond.cause = Incident::Cause::goal;
  return beyond;
}

void Controller::bridge() noexcept {
  const double since = blind_ ? incident_.time : tick_.time;
  blind_ = true;
  if (status_ == Status::stopped) return;
  status_ = Status::bridging;
  if (guard_.lost()) stop(guard_.dropout());
  incident_ = guard_.dropout();
  incident_.time = since;
}

// From where the joints turn out to be, without a step in torque.
void Controller::regain() noexcept {
  here_.position = q() - tick_.reference.position;
  here_.velocity = qd() - law_.velocity();
  tick_.reference.position = q();
  tick_.reference.velocity += here_.velocity;
  law_.go_on(qd());
  if (status_ == Status::stopped) {
    brake_from(tick_.reference);
  } else {
    offset_.shift(here_.position, here_.velocity);
    status_ = Status::following;
  }
}

void Controller::plan(double dt) noexcept {
  sequencer_.step(dt);
  offset_.advance(dt);
  next_sequence_ = sequencer_.sample();
  follow(next_sequence_, next_);
  if (status_ != Status::stopped) return;
  brake_.step(dt);
  next_ = brake_.sample();
}

void Controller::command(double dt, bool there) noexcept {
  law_.set_gravity(robot_.gravity_in_base());
  if (there)
    law_.torque(dt, q(), qd(), tick_.reference, next_.position, tick_.torque);
  else
    law_.torque(dt, tick_.reference, next_.position, tick_.torque);
  if (!std::isfinite(tick_.torque.sum())) tick_.torque.setZero();
  apply_torque(actuator_.deliver(dt, tick_.torque));
}

// The joints' reference for a sample of the sequence, or the end of following it.
void Controller::follow(const Sample& sequence, Sample& joints) noexcept {
  if (status_ == Status::stopped) return;
  if (!joints_->find(sequence, joints)) {
    Incident unreachable;
    unreachable.cause = Incident::Cause::unreachable;
    return stop(unreachable);
  }
  offset_.add_to(joints);
  const Incident beyond = guard_.beyond_limits(joints.position);
  if (beyond.cause != Incident::Cause::none) stop(beyond);
}

// Where there is no reference any more the joints come to rest from the last one that there was.
void Controller::stop(const Incident& incident) noexcept {
  status_ = Status::stopped;
  incident_ = incident;
  incident_.time = tick_.time;
  brake_from(tick_.reference);
}

// From where the joints are; once stopped, wherever they are taken is where they rest.
void Controller::stop_here(const Incident& incident) noexcept {
  tick_.reference.position = q();
  tick_.reference.acceleration.setZero();
  if (status_ == Status::stopped) {
    tick_.reference.velocity.setZero();
    brake_from(tick_.reference);
  } else {
    tick_.reference.velocity = qd();
    stop(incident);
  }
  law_.go_on(tick_.reference.velocity);
}

void Controller::brake_from(const Sample& from) noexcept {
  coming_to_rest_ = from.position + stopping_time * from.velocity;
  guard_.keep_within_limits(from.position, coming_to_rest_);
  followers_.place(coming_to_rest_);
  brake_.set_goal(coming_to_rest_);
  brake_.reinitialise(from, 1.0, Join::dmp3);
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
