#include <cmath>

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <seam/controller.hpp>
#include <seam/error.hpp>
#include <seam/plugin.hpp>

namespace seam {

namespace {

std::vector<Eigen::Index> joints_of(const Sequence& sequence, const RobotModel& model) {
  std::vector<Eigen::Index> joints;
  for (const std::string& coordinate : sequence.coordinates())
    joints.push_back(model.joint(coordinate));
  return joints;
}

Sample measured(const Robot& robot) {
  Sample state(robot.dof());
  robot.state(state.position, state.velocity);
  return state;
}

Sample selected(const Sample& state, const std::vector<Eigen::Index>& joints) {
  Sample part(static_cast<int>(joints.size()));
  part.position = state.position(joints);
  part.velocity = state.velocity(joints);
  return part;
}

const ControlSettings& valid(const ControlSettings& settings) {
  for (const double gain : {settings.Kp, settings.Kd})
    if (!(std::isfinite(gain) && gain >= 0.0))
      throw Error("controller", "gain " + std::to_string(gain) + ", must be >= 0");
  return settings;
}

// Moves nothing: see apply_torque.
constexpr double mark = 0.1234567890123;  // [N·m]

}  // namespace

void require_reachable(const Primitive& primitive, const RobotModel& robot) {
  for (std::size_t c = 0; c < primitive.coordinates.size(); ++c) {
    const int i = robot.joint(primitive.coordinates[c]);
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    const double goal = primitive.goal(static_cast<Eigen::Index>(c));
    if (goal < joint.lower || goal > joint.upper)
      throw Error("joint \"" + joint.name + "\"", "goal " + std::to_string(goal) + ", must be in " +
                                                      std::to_string(joint.lower) + " to " +
                                                      std::to_string(joint.upper));
  }
}

Controller::Controller(Robot& robot, const Sequence& sequence, const JoinSettings& join,
                       const ControlSettings& settings)
    : robot_(robot),
      joints_(joints_of(sequence, robot.model())),
      sequencer_(sequence, join, selected(measured(robot), joints_)),
      law_(InverseDynamics(robot.model()), valid(settings)) {
  for (const Sequence::Step& step : sequence.steps())
    require_reachable(step.primitive, robot.model());
  const Sample state = measured(robot);
  tick_.q = state.position;
  tick_.qd = state.velocity;
  tick_.torque.setZero(robot.dof());
  tick_.reference = Sample::at_rest(state.position);
  tick_.reference.velocity(joints_) = sequencer_.sample().velocity;
  law_.start(tick_.reference.velocity);
  next_ = state.position;
  applied_.setZero(robot.dof());
}

Controller::~Controller() {
  if (plugin_) plugin_->remove(*this);
}

void Controller::pre_tick(double dt) noexcept {
  if (!(dt > 0.0)) return;
  tick_.time = sequencer_.time();
  tick_.running = sequencer_.running();
  robot_.state(tick_.q, tick_.qd);
  const Sample& now = sequencer_.sample();
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    const auto d = static_cast<Eigen::Index>(c);
    tick_.reference.position(joints_[c]) = now.position(d);
    tick_.reference.velocity(joints_[c]) = now.velocity(d);
    tick_.reference.acceleration(joints_[c]) = now.acceleration(d);
  }
  sequencer_.step(dt);
  for (std::size_t c = 0; c < joints_.size(); ++c)
    next_(joints_[c]) = sequencer_.sample().position(static_cast<Eigen::Index>(c));
  law_.set_gravity(robot_.gravity_in_base());
  law_.torque(dt, tick_.q, tick_.qd, tick_.reference, next_, tick_.torque);
  apply_torque();
}

// Bullet clears joint torques once per stepSimulation and not per substep. The base of a fixed-base
// multibody bears a torque that moves nothing and is cleared with them: if it is still what we left,
// our joint torques still stand too.
void Controller::apply_torque() noexcept {
  btMultiBody& multibody = robot_.multibody();
  const bool still_stands = marked_ && multibody.getBaseTorque().x() == base_torque_;
  if (still_stands)
    applied_ = tick_.torque - applied_;
  else
    applied_ = tick_.torque;
  for (int i = 0; i < robot_.dof(); ++i) multibody.addJointTorque(i, applied_(i));
  if (!still_stands) multibody.addBaseTorque(btVector3(mark, 0.0, 0.0));
  applied_ = tick_.torque;
  base_torque_ = multibody.getBaseTorque().x();
  marked_ = true;
}

}  // namespace seam
