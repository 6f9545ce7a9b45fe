#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/arm_controller.hpp>
#include <seam/export.hpp>
#include <seam/robot.hpp>

namespace SEAM_API seam {

class Plugin;

/// What a controller takes its sequence, its robot and its hardware for.
struct ControllerSettings : ArmControllerSettings {
  /// What the controller takes the robot for: a model that errs, or one without the passive joints that the robot in
  /// Bullet has behind all others. Else the robot's own.
  std::optional<RobotModel> model;

  ControllerSettings() = default;
  /// With an ideal actuator and sensor.
  ControllerSettings(const ControlSettings& control, std::optional<ToolSettings> of = std::nullopt,
                     std::optional<RobotModel> known = std::nullopt)
      : ArmControllerSettings(control, std::move(of)), model(std::move(known)) {}
};

/// An ArmController for a robot in Bullet: takes the state from it, and adds the torque to its joints.
///
/// Once per Bullet tick, before the forces are used, `pre_tick(dt)` reads the state, advances the
/// sequence by dt, and adds the computed torque to the joints. `Plugin` makes those calls; an app
/// that owns its tick callback makes them itself. It is right for any number of substeps, and
/// does not touch torques that the app adds (see Robot::drive, which it calls). One controller at a time for a robot, which is
/// borrowed and must outlive it.
class Controller {
 public:
  using Status = ArmController::Status;  // whether the joints do what the sequence says
  using Tick = ArmController::Tick;      // the work of one tick

  /// @throws Error  the robot has a controller already, a model whose joints are not the robot's first
  ///                ones, and whatever ArmController refuses
  Controller(Robot& robot, const Sequence& sequence, const JoinSettings& join,
             const ControllerSettings& settings = {});
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  ~Controller();

  /// @param dt  [s] Bullet's tick; nothing is done unless it is > 0
  void pre_tick(double dt) noexcept;

  /// Takes the sequence up again from where the robot is now, after it was reset, teleported or moved by something else, or
  /// once what stopped it is over: see ArmController::reinitialise.
  bool reinitialise() noexcept;

  /// The last switch has been due; the arm goes on to the last goal and stays there.
  bool finished() const noexcept { return arm_.finished(); }
  Status status() const noexcept { return arm_.status(); }  // now
  /// What made it bridge or stop last; none since it was made or re-initialised.
  const Incident& incident() const noexcept { return arm_.incident(); }
  /// In one line.
  std::string what_happened() const { return arm_.what_happened(); }
  /// The sequence as it runs: for changing its goal, tau, amplitude and queue between ticks.
  Sequencer& sequencer() noexcept { return arm_.sequencer(); }
  const Sequencer& sequencer() const noexcept { return arm_.sequencer(); }  // to look at
  const Tick& last_tick() const noexcept { return arm_.last_tick(); }       // of the last pre_tick
  /// In it a drive was held back by its effort limit or its rate.
  bool limited() const noexcept { return arm_.limited(); }

 private:
  friend class Plugin;

  // That a robot has one controller. It may be gone before that.
  class Claim {
   public:
    explicit Claim(const Robot& robot);
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    ~Claim() { *controlled_ = false; }

   private:
    std::shared_ptr<bool> controlled_;
  };

  Robot& robot_;
  Claim claim_;
  Plugin* plugin_ = nullptr;
  Eigen::VectorXd q_, qd_;  // n, what the encoders see
  ArmController arm_;
};

}  // namespace seam
