#include "bench/micro/arms.hpp"

#include <cmath>
#include <limits>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "scenes/own_folders.hpp"
#include "scenes/scene.hpp"

namespace seam::micro {

namespace {

constexpr double apart = 4.0;  // [m]
constexpr int in_a_row = 16;

Eigen::VectorXd start() {
  Eigen::VectorXd q(7);
  q << 0.1, 0.4, -0.1, 1.2, 0.2, 0.8, 0.0;
  return q;
}

// From one position to another in a second, with the velocity of a cosine.
Primitive reach(const std::vector<std::string>& coordinates, const Eigen::VectorXd& from,
                const Eigen::VectorXd& by) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(501, 0.0, 1.0);
  const Eigen::VectorXd share = 0.5 * (1.0 - (M_PI * time.array()).cos());
  const Eigen::MatrixXd position =
      share * by.transpose() + Eigen::VectorXd::Ones(time.size()) * from.transpose();
  return learn(Demonstration::from_positions(coordinates, time, position));
}

Sequence there_and_back(const Primitive& there, const Primitive& back) {
  Sequence sequence;
  sequence.then(there).until(before_end(0.3)).then(back);
  return sequence;
}

}  // namespace

const RobotModel& pa10() {
  static const RobotModel model = RobotModel::read(own_folder() + "/assets/pa10/pa10.urdf");
  return model;
}

const RobotModel& pa10_with_drives() {
  static const RobotModel model =
      Scene::read(own_folder() + "/scenes/line.yaml", {"arm=published"}).simulated;
  return model;
}

Movement joint_movement() {
  std::vector<std::string> names;
  for (const Joint& joint : pa10().joints) names.push_back(joint.name);
  const Eigen::VectorXd by = Eigen::VectorXd::LinSpaced(7, 0.4, -0.2);
  const Eigen::VectorXd from = start();
  return {there_and_back(reach(names, from, by), reach(names, from + by, -by)), from, {}};
}

Movement tool_movement() {
  Kinematics tool(pa10(), "tool");
  tool.move_to(start());
  Eigen::VectorXd from = Eigen::VectorXd::Zero(6);
  from.head<3>() = tool.X_base_tool().translation();
  Eigen::VectorXd by(6);
  by << 0.08, -0.1, 0.06, 0.3, -0.2, 0.25;
  const std::vector<std::string> names = {"x", "y", "z", "rx", "ry", "rz"};
  Primitive there = reach(names, from, by);
  Primitive back = reach(names, from + by, -by);
  there.reference_orientation = back.reference_orientation =
      Eigen::Quaterniond(tool.X_base_tool().linear()).normalized();
  ToolSettings settings;
  settings.link = "tool";
  return {there_and_back(there, back), start(), settings};
}

// A tick is timed many times at one state, which is no dropout here.
ControllerSettings settings_for(const Movement& movement) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ControllerSettings settings({}, movement.tool);
  settings.guard.most_error = settings.guard.longest_dropout = settings.guard.frozen_beyond =
      infinity;
  return settings;
}

Arms::Arms(int count, const Movement& movement, Join join, const RobotModel& model)
    : movement_(movement), join_(join) {
  for (int i = 0; i < count; ++i) {
    RobotSettings settings;
    settings.X_world_base.translation() << apart * (i % in_a_row), apart * (i / in_a_row), 0.0;
    arms_.push_back(std::make_unique<Arm>(model, settings, world_));
  }
  restart();
}

void Arms::restart() {
  const ControllerSettings settings = settings_for(movement_);
  plugin_ = std::make_unique<Plugin>(*world_);
  for (const auto& arm : arms_) {
    arm->controller.reset();
    arm->robot.multibody().clearForcesAndTorques();
    arm->robot.reset(movement_.start, Eigen::VectorXd::Zero(movement_.start.size()));
    arm->controller = std::make_unique<Controller>(arm->robot, movement_.sequence, join_, settings);
    plugin_->add(*arm->controller);
  }
}

void Arms::tick() noexcept {
  for (const auto& arm : arms_) arm->controller->pre_tick(dt);
}

void Arms::step() {
  world_->stepSimulation(dt, 0);
}

void Arms::step(const Eigen::VectorXd& torque) {
  plugin_.reset();
  for (const auto& arm : arms_)
    for (int i = 0; i < torque.size(); ++i) arm->robot.multibody().addJointTorque(i, torque(i));
  world_->stepSimulation(dt, 0);
}

std::vector<Controller::Tick> played(const Movement& movement, Join join) {
  Arms arms(1, movement, join);
  std::vector<Controller::Tick> ticks;
  while (!arms.first().finished()) {
    arms.step();
    ticks.push_back(arms.first().last_tick());
  }
  return ticks;
}

}  // namespace seam::micro
