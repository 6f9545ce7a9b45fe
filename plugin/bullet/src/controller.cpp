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

void require_reachable(const Sequence& sequence, const std::vector<Eigen::Index>& joints,
                       const RobotModel& model) {
  for (const Sequence::Step& step : sequence.steps())
    for (std::size_t c = 0; c < joints.size(); ++c) {
      const Joint& joint = model.joints[static_cast<std::size_t>(joints[c])];
      const double goal = step.primitive.goal(static_cast<Eigen::Index>(c));
      if (goal < joint.lower || goal > joint.upper)
        throw Error("controller", "joint \"" + joint.name + "\": goal " + std::to_string(goal) +
                                      ", must be in " + std::to_string(joint.lower) + " to " +
                                      std::to_string(joint.upper));
    }
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

// Bullet clears joint torques once per stepSimulation, not per substep. The base of a fixed-base
// multibody bears a torque that moves nothing and is cleared with them: a mark there tells whether
// ours still stands.
bool torque_still_stands(const btMultiBody& multibody) {
  return multibody.getBaseTorque().x() != 0.0;
}
void mark_torque(btMultiBody& multibody) {
  multibody.addBaseTorque(btVector3(1.0, 0.0, 0.0));
}

}  // namespace

Controller::Controller(Robot& robot, const Sequence& sequence, Join method,
                       const ControlSettings& settings)
    : robot_(robot),
      joints_(joints_of(sequence, robot.model())),
      sequencer_(sequence, method, selected(measured(robot), joints_)),
      law_(InverseDynamics(robot.model()), valid(settings)) {
  require_reachable(sequence, joints_, robot.model());
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

void Controller::apply_torque() noexcept {
  btMultiBody& multibody = robot_.multibody();
  if (torque_still_stands(multibody))
    applied_ = tick_.torque - applied_;
  else
    applied_ = tick_.torque;
  for (int i = 0; i < robot_.dof(); ++i) multibody.addJointTorque(i, applied_(i));
  if (!torque_still_stands(multibody)) mark_torque(multibody);
  applied_ = tick_.torque;
}

}  // namespace seam
