#include <cassert>
#include <cmath>

#include "driven_inertia.hpp"
#include "settings_check.hpp"
#include "state_check.hpp"
#include <seam/arm_controller.hpp>
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr int unknown = -1;        // joins so far
constexpr double brake_tau = 0.5;  // [s]
// Three time constants of the triple pole, so that no joint turns back [s].
const double stopping_time = 3.0 * brake_tau / Gains().H;

std::unique_ptr<JointReference> reference(const RobotModel& model, const Sequence& sequence,
                                          const std::optional<ToolSettings>& tool,
                                          const Eigen::VectorXd& q) {
  std::unique_ptr<JointReference> joints;
  if (tool)
    joints = std::make_unique<TaskSpace>(model, sequence, *tool, q);
  else
    joints = std::make_unique<JointSpace>(model, sequence.coordinates());
  for (const Sequence::Step& step : sequence.steps()) joints->require_reachable_step(step);
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

ArmController::Tick tick_at(const RobotModel& model, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& qd) {
  require_one_each("controller: q", q, model.dof());
  require_one_each("controller: qd", qd, model.dof());
  if (!(finite(q) && finite(qd))) throw Error("controller", "the joints' state is not finite");
  ArmController::Tick tick;
  tick.q = q;
  tick.qd = qd;
  tick.torque.setZero(model.dof());
  tick.reference = Sample::at_rest(q);
  return tick;
}

// Of the feedback, in the posture where the controller is made.
Eigen::VectorXd stiffness(const RobotModel& model, const ControlSettings& law,
                          const Eigen::VectorXd& q) {
  return driven_inertia(model, q).cwiseProduct(law.Kp.each(model.dof()));
}

// All but the jerk, which the sequencer does not keep up to date.
void take_over(const Sample& motion, Sample& into) {
  into.position = motion.position;
  into.velocity = motion.velocity;
  into.acceleration = motion.acceleration;
}

}  // namespace

ArmController::ArmController(const RobotModel& model, const Sequence& sequence,
                             const JoinSettings& join, const ArmControllerSettings& settings,
                             const Eigen::VectorXd& q, const Eigen::VectorXd& qd)
    : tick_(tick_at(model, q, qd)),
      next_(tick_.reference),
      joints_(reference(model, sequence, settings.tool, q)),
      sequencer_(sequence, join, joints_->measured(q, qd)),
      law_(model, settings.law, q),
      guard_(model, settings.guard, settings.sensor.delay, stiffness(model, settings.law, q)),
      offset_(model.dof()),
      actuator_(model, settings.actuator),
      sensor_(model, settings.sensor),
      brake_(rest_at(q)),
      coming_to_rest_(q),
      followers_(model),
      taken_up_(sequencer_.sample()),
      here_(tick_.reference),
      at_goal_(q),
      model_(model) {
  here_.velocity = qd;
  begin_here();
  tick_.sequence = sequencer_.sample();
  tick_.reference = next_;
}

// From what the sequence has the joints do now, and what they do: the difference fades.
void ArmController::begin_here() noexcept {
  joints_->find(sequencer_.sample(), next_);
  law_.start(here_.velocity);
  guard_.restart(here_.position);
  here_.position -= next_.position;
  here_.velocity -= next_.velocity;
  offset_.start(here_.position, here_.velocity);
  offset_.add_to(next_);
  changes_ = sequencer_.changes();
  joins_ = unknown;  // for the goal to be looked at by the new bounds
}

bool ArmController::reinitialise(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) noexcept {
  assert(q.size() == dof() && qd.size() == dof());
  here_.position = q;
  here_.velocity = qd;
  if (goal_beyond_limits().cause != Incident::Cause::none ||
      !(finite(here_.position) && finite(here_.velocity)) ||
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

const Eigen::VectorXd& ArmController::tick(double dt, const Eigen::VectorXd& q,
                                           const Eigen::VectorXd& qd) noexcept {
  assert(q.size() == dof() && qd.size() == dof());
  if (!(dt > 0.0)) return actuator_.delivered(tick_.torque);
  tick_.q = q;
  tick_.qd = qd;
  begin_tick();
  const bool there = measure(dt);
  watch(there);
  plan(dt);
  command(dt, there);
  return actuator_.deliver(dt, tick_.torque);
}

void ArmController::begin_tick() noexcept {
  tick_.time = sequencer_.time();
  tick_.running = sequencer_.running();
  take_over(sequencer_.sample(), tick_.sequence);
  tick_.reference.swap(next_);
  if (sequencer_.joins() != joins_ || sequencer_.changes() != changes_) look_at_goal();
  if (sequencer_.changes() != changes_) follow(tick_.sequence, tick_.reference);
  joins_ = sequencer_.joins();
  changes_ = sequencer_.changes();
  tick_.tool_error = joints_->miss(tick_.sequence, tick_.q);
}

bool ArmController::measure(double dt) noexcept {
  if (!sensor_.ideal()) sensor_.measure(dt, tick_.q, tick_.qd);
  return guard_.trusts(dt, q(), qd(), tick_.reference.position);
}

void ArmController::watch(bool there) noexcept {
  if (!there) return bridge();
  if (blind_) regain();
  blind_ = false;
  const Incident off = guard_.deviation(q(), tick_.reference.position, actuator_.limited());
  if (off.cause != Incident::Cause::none) stop_here(off);
}

// Before what it makes of the motion is taken over.
void ArmController::look_at_goal() noexcept {
  if (status_ == Status::stopped) return;
  const Incident beyond = goal_beyond_limits();
  if (beyond.cause != Incident::Cause::none) stop(beyond);
}

Incident ArmController::goal_beyond_limits() noexcept {
  if (!joints_->at_goal(sequencer_.goal(), at_goal_)) return {};
  Incident beyond = guard_.beyond_limits(at_goal_);
  if (beyond.cause != Incident::Cause::none) beyond.cause = Incident::Cause::goal;
  return beyond;
}

void ArmController::bridge() noexcept {
  const double since = blind_ ? incident_.time : tick_.time;
  blind_ = true;
  if (status_ == Status::stopped) return;
  status_ = Status::bridging;
  if (guard_.lost()) stop(guard_.dropout());
  incident_ = guard_.dropout();
  incident_.time = since;
}

// From where the joints turn out to be, without a step in torque.
void ArmController::regain() noexcept {
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

void ArmController::plan(double dt) noexcept {
  sequencer_.step(dt);
  offset_.advance(dt);
  follow(sequencer_.sample(), next_);
  if (status_ != Status::stopped) return;
  brake_.step(dt);
  take_over(brake_.sample(), next_);
}

void ArmController::command(double dt, bool there) noexcept {
  if (actuator_.limited() || status_ == Status::stopped) law_.hold_observer();
  if (there)
    law_.torque(dt, q(), qd(), tick_.reference, next_.position, tick_.torque);
  else
    law_.torque(dt, tick_.reference, next_.position, tick_.torque);
  if (!finite(tick_.torque)) tick_.torque.setZero();
}

// The joints' reference for a sample of the sequence, or the end of following it.
void ArmController::follow(const Sample& sequence, Sample& joints) noexcept {
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
void ArmController::stop(const Incident& incident) noexcept {
  status_ = Status::stopped;
  incident_ = incident;
  incident_.time = tick_.time;
  brake_from(tick_.reference);
}

// From where the joints are; once stopped, wherever they are taken is where they rest.
void ArmController::stop_here(const Incident& incident) noexcept {
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
  law_.reset_observer();  // of what the arm has hit
}

void ArmController::brake_from(const Sample& from) noexcept {
  coming_to_rest_ = from.position + stopping_time * from.velocity;
  guard_.keep_within_limits(from.position, coming_to_rest_);
  followers_.place(coming_to_rest_);
  brake_.set_goal(coming_to_rest_);
  brake_.reinitialise(from, 1.0, Join::dmp3);
}

}  // namespace seam
