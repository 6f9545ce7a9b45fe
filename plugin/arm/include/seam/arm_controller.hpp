#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <seam/actuator.hpp>
#include <seam/alignment.hpp>
#include <seam/computed_torque.hpp>
#include <seam/export.hpp>
#include <seam/fading_offset.hpp>
#include <seam/guard.hpp>
#include <seam/joint_reference.hpp>
#include <seam/sensor.hpp>
#include <seam/sequencer.hpp>

namespace SEAM_API seam {

/// What an arm's controller takes its sequence and its hardware for.
struct ArmControllerSettings {
  ControlSettings law;  // feedback and reference
  std::optional<ToolSettings>
      tool;                   // the sequence's coordinates are this tool's, else they are joints
  ActuatorSettings actuator;  // between the command and the joints
  SensorSettings sensor;      // between the joints and the controller
  GuardSettings guard;        // of the arm

  ArmControllerSettings() = default;
  /// With an ideal actuator and sensor.
  ArmControllerSettings(const ControlSettings& control,
                        std::optional<ToolSettings> of = std::nullopt)
      : law(control), tool(std::move(of)) {}
};

/// Plays a sequence of primitives on an arm, in joint space (coordinates are joint names; joints that are not named hold the
/// position they have now) or in task space (see TaskSpace). The arm's state comes in, the joints' torque goes out; where
/// the state comes from and what the torque moves is the caller's: a simulator of any make, or an arm.
///
/// Once per tick `tick(dt, q, qd)` advances the sequence by dt and gives the torque that is to act from now until dt later.
/// The default reference (see ComputedTorque) is made for semi-implicit integration, q̇ ← q̇ + dt·q̈, then q ← q + dt·q̇, under
/// which the joints arrive at the sequence's positions exactly.
///
/// Where the arm cannot follow, the joints come to rest within about half a second, and stay there: from the reference, as
/// smoothly as at a join, or, where a joint was too far from it (a hit, drives that are too weak), from where they are. While
/// there is no state, the torque is that of the reference alone; once there is one again, what the joints are off by fades within a
/// second. A controller that has stopped holds the joints where they
/// came to rest, gives way again where they are pushed too far, and waits for `reinitialise`; the sequence's time goes on.
///
/// Construction allocates; `tick` and `reinitialise` do not, and do not throw.
class ArmController {
 public:
  /// Whether the joints do what the sequence says.
  enum class Status {
    following,
    bridging,  ///< there is no state, for a while; it follows again once there is one
    stopped,   ///< see incident()
  };

  /// The work of one tick: the state and reference at its beginning, and the torque commanded for
  /// it (what the actuator delivers is another where it is not ideal).
  struct Tick {
    double time = 0.0;       // [s] since the controller was made
    int running = -1;        // index of the running primitive, -1 before the first
    Sample sequence;         // its coordinates
    Sample reference;        // n joints of the controller's model
    ToolError tool_error;    // at the tick's beginning; nothing in joint space
    Eigen::VectorXd q;       // n [rad]; true, where the sensor is not ideal
    Eigen::VectorXd qd;      // n [rad/s]; likewise
    Eigen::VectorXd torque;  // n [N·m]
  };

  /// @param model  what the controller takes the arm for; of n joints
  /// @param q      [rad or m] where the joints are now, n values
  /// @param qd     [rad/s or m/s] how they move, n values
  /// @throws Error  not n values, a coordinate is not a joint of the model, a goal is outside a joint's limits or out of reach, an
  ///                empty sequence, gains that are negative or not finite, and whatever InverseDynamics, TaskSpace, Actuator, Sensor
  ///                and Guard refuse
  ArmController(const RobotModel& model, const Sequence& sequence, const JoinSettings& join,
                const ArmControllerSettings& settings, const Eigen::VectorXd& q,
                const Eigen::VectorXd& qd);

  /// Gravity [m/s²] in the frame of the robot's root link, from the next tick on; (0, 0, -9.81) to begin with.
  void set_gravity(const Eigen::Vector3d& gravity_in_base) noexcept {
    law_.set_gravity(gravity_in_base);
  }

  /// @param dt  [s] from this tick to the next; nothing is done unless it is > 0
  /// @param q   [rad or m] where the joints are, n values; NaN where that is not known
  /// @param qd  [rad/s or m/s] how they move, n values
  /// @return    what the actuator delivers to the joints until the next tick, n [N·m or N]; lasts until then
  const Eigen::VectorXd& tick(double dt, const Eigen::VectorXd& q,
                              const Eigen::VectorXd& qd) noexcept;

  /// Takes the sequence up again from where the arm is now: after it was moved by something else, or once what stopped it is
  /// over. What runs now is joined to the joints' state, at rest in acceleration; joints that are
  /// not named hold where they are now; what the coordinates do not reach (the posture of a redundant arm) fades to what
  /// the sequence asks for within a second. What the feedback had to hold is let go of. From far away a larger tau, set
  /// before, makes the way back gentle.
  /// @return  false, and nothing is changed, where the goal is beyond a joint's limits, the state is not finite, or the
  ///          tool's is not one that can be followed
  bool reinitialise(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) noexcept;

  int dof() const noexcept { return model_.dof(); }            // n joints
  const RobotModel& model() const noexcept { return model_; }  // what it takes the arm for
  /// The last switch has been due; the arm goes on to the last goal and stays there.
  bool finished() const noexcept { return sequencer_.finished(); }
  Status status() const noexcept { return status_; }  // now
  /// What made it bridge or stop last; none since it was made or re-initialised.
  const Incident& incident() const noexcept { return incident_; }
  /// In one line.
  std::string what_happened() const { return describe(incident_, model_); }
  /// The sequence as it runs: for changing its goal, tau, amplitude and queue between ticks.
  Sequencer& sequencer() noexcept { return sequencer_; }
  const Sequencer& sequencer() const noexcept { return sequencer_; }  // to look at
  const Tick& last_tick() const noexcept { return tick_; }            // of the last call of `tick`
  /// In it a drive was held back by its effort limit or its rate.
  bool limited() const noexcept { return actuator_.limited(); }

 private:
  const Eigen::VectorXd& q() const noexcept { return sensor_.ideal() ? tick_.q : sensor_.q(); }
  const Eigen::VectorXd& qd() const noexcept { return sensor_.ideal() ? tick_.qd : sensor_.qd(); }
  void begin_here() noexcept;
  void begin_tick() noexcept;
  bool measure(double dt) noexcept;
  void watch(bool there) noexcept;
  void look_at_goal() noexcept;
  Incident goal_beyond_limits() noexcept;
  void bridge() noexcept;
  void regain() noexcept;
  void plan(double dt) noexcept;
  void command(double dt, bool there) noexcept;
  void follow(const Sample& sequence, Sample& joints) noexcept;
  void stop(const Incident& incident) noexcept;
  void stop_here(const Incident& incident) noexcept;
  void brake_from(const Sample& from) noexcept;

  // What every tick touches comes first, so that it lies together.
  Tick tick_;
  Sample next_;  // n, the reference at the end of the tick
  std::unique_ptr<JointReference> joints_;
  Sequencer sequencer_;
  ComputedTorque law_;
  Guard guard_;
  int joins_ = 0;         // of the sequencer, when its goal was looked at
  unsigned changes_ = 0;  // likewise, when the reference was found
  Status status_ = Status::following;
  bool blind_ = false;   // there was no state in the last tick
  FadingOffset offset_;  // of the reference from what the sequence asks for
  Actuator actuator_;
  Sensor sensor_;
  Execution brake_;                 // n joints; leads to rest
  Eigen::VectorXd coming_to_rest_;  // n
  Followers followers_;
  Sample taken_up_;          // of the sequence, that it was re-initialised with
  Sample here_;              // n, the joints' state
  Eigen::VectorXd at_goal_;  // n
  Incident incident_;
  RobotModel model_;
};

}  // namespace seam
