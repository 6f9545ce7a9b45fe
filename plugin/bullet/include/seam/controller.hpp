#pragma once

#include <memory>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include <seam/actuator.hpp>
#include <seam/computed_torque.hpp>
#include <seam/export.hpp>
#include <seam/joint_reference.hpp>
#include <seam/robot.hpp>
#include <seam/sensor.hpp>
#include <seam/sequencer.hpp>

namespace SEAM_API seam {

class Plugin;

struct ControllerSettings {
  ControlSettings law;
  std::optional<ToolSettings>
      tool;  // the sequence's coordinates are this tool's, else they are joints
  /// What the controller takes the robot for: a model that errs, or one without the passive joints that the robot in
  /// Bullet has behind all others. Else the robot's own.
  std::optional<RobotModel> model;
  ActuatorSettings actuator;
  SensorSettings sensor;

  ControllerSettings() = default;
  ControllerSettings(const ControlSettings& control, std::optional<ToolSettings> of = std::nullopt,
                     std::optional<RobotModel> known = std::nullopt)
      : law(control), tool(std::move(of)), model(std::move(known)) {}
};

/// Plays a sequence of primitives on a robot in Bullet, in joint space (coordinates are joint names; joints that are not
/// named hold the position they have now) or in task space (see TaskSpace).
///
/// Once per Bullet tick, before the forces are used, `pre_tick(dt)` reads the state, advances the
/// sequence by dt, and adds the computed torque to the joints. `Plugin` makes those calls; an app
/// that owns its tick callback makes them itself. It is right for any number of substeps, and
/// leaves torques alone that the app adds. To tell substeps apart it adds a torque of 0.12 N·m to the
/// fixed base, which moves nothing; an app that adds base torques from inside the tick would be in
/// its way. One controller at a time for a robot, which is borrowed and must outlive it.
class Controller {
 public:
  enum class Status {
    following,
    stopped,  ///< the sequence led where the joints cannot follow (out of reach, a joint's limit, a singularity): they
              ///< come to rest smoothly from where they were, and stay
  };

  /// The work of one tick: the state and reference at its beginning, and the torque commanded for
  /// it (what the actuator delivers is another where it is not ideal).
  struct Tick {
    double time = 0.0;       // [s] since the controller was made
    int running = -1;        // index of the running primitive, -1 before the first
    Sample sequence;         // its coordinates
    Sample reference;        // n joints of the controller's model
    ToolError tool_error;    // at the tick's beginning; nothing in joint space
    Eigen::VectorXd q, qd;   // n [rad], [rad/s]; true, where the sensor is not ideal
    Eigen::VectorXd torque;  // n [N·m]
  };

  /// @throws Error  a coordinate is not a joint of the robot, a goal is outside a joint's limits or out of reach, an
  ///                empty sequence, gains that are negative or not finite, a model whose joints are not the robot's first
  ///                ones, and whatever TaskSpace refuses
  Controller(Robot& robot, const Sequence& sequence, const JoinSettings& join,
             const ControllerSettings& settings = {});
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  ~Controller();

  /// @param dt  [s] Bullet's tick; nothing is done unless it is > 0
  void pre_tick(double dt) noexcept;

  /// The last switch has been due; the arm goes on to the last goal and stays there.
  bool finished() const noexcept { return sequencer_.finished(); }
  Status status() const noexcept { return status_; }
  /// The sequence as it runs: for changing its goal, tau, amplitude and queue between ticks.
  Sequencer& sequencer() noexcept { return sequencer_; }
  const Sequencer& sequencer() const noexcept { return sequencer_; }
  const Tick& last_tick() const noexcept { return tick_; }

 private:
  friend class Plugin;

  void follow(const Sample& sequence, Sample& joints) noexcept;
  void apply_torque(const Eigen::VectorXd& torque) noexcept;

  Robot& robot_;
  Tick tick_;
  std::unique_ptr<JointReference> joints_;
  Sequencer sequencer_;
  Execution brake_;                 // n joints; leads to rest
  Eigen::VectorXd coming_to_rest_;  // n
  ComputedTorque law_;
  Sensor sensor_;
  Actuator actuator_;
  Sample next_sequence_;  // at the end of the tick
  Sample next_;           // n, the reference then
  Status status_ = Status::following;
  double base_torque_ = 0.0;  // [N·m] on the base, as we left it
  bool marked_ = false;
  Eigen::VectorXd applied_;  // n [N·m] that of ours which still stands in the multibody
  Plugin* plugin_ = nullptr;
};

}  // namespace seam
