#pragma once

#include <memory>
#include <vector>

#include "scenes/world.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

namespace seam::micro {

constexpr double dt = 1e-3;  // [s]

const RobotModel& pa10();
/// The same with the rotors and the friction that were published.
const RobotModel& pa10_with_drives();

/// A movement of the PA-10 and where it begins.
struct Movement {
  Sequence sequence;
  Eigen::VectorXd start;  // [rad]
  std::optional<ToolSettings> tool;
};
/// Two reaches, the second joined to the first on the way: of all seven joints, or of the tool's position and orientation.
Movement joint_movement();
Movement tool_movement();

/// A controller's settings for a movement, with a guard that stops nothing.
ControllerSettings settings_for(const Movement& movement);

/// PA-10s (or what else moves as they do) in one world, too far apart to meet, which all make the same movement.
class Arms {
 public:
  Arms(int count, const Movement& movement, Join join, const RobotModel& model = pa10());

  /// At the beginning of the movement.
  void restart();
  /// The ticks of all controllers, nothing of Bullet's.
  void tick() noexcept;
  /// The tick of one.
  void tick(int arm) noexcept { arms_[static_cast<std::size_t>(arm)]->controller->pre_tick(dt); }
  /// Bullet's step with the plug-in.
  void step();
  /// Bullet's step without it, which goes until `restart`, with torques for the joints of each arm.
  void step(const Eigen::VectorXd& torque);

  const Controller& first() const { return *arms_[0]->controller; }
  /// Puts the first arm there.
  void place(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) { arms_[0]->robot.reset(q, qd); }

 private:
  struct Arm {
    Arm(const RobotModel& model, const RobotSettings& settings, World& world)
        : robot(model, *world, settings) {}
    Robot robot;
    std::unique_ptr<Controller> controller;
  };

  Movement movement_;
  Join join_;
  World world_;
  std::vector<std::unique_ptr<Arm>> arms_;
  std::unique_ptr<Plugin> plugin_;
};

/// What an arm does at each tick of the movement.
std::vector<Controller::Tick> played(const Movement& movement, Join join);

}  // namespace seam::micro
