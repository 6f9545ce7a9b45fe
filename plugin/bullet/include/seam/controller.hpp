#pragma once

#include <vector>

#include <Eigen/Core>

#include <seam/computed_torque.hpp>
#include <seam/robot.hpp>
#include <seam/sequencer.hpp>

namespace seam {

class Plugin;

/// @throws Error  a coordinate is not a joint of the robot, or the goal is outside a joint's limits
void require_reachable(const Primitive& primitive, const RobotModel& robot);

/// Plays a sequence of joint-space primitives on a robot in Bullet. The sequence's coordinates are
/// joint names; joints that it does not name hold the position they have now.
///
/// Once per Bullet tick, before the forces are used, `pre_tick(dt)` reads the state, advances the
/// sequence by dt, and adds the computed torque to the joints. `Plugin` makes those calls; an app
/// that owns its tick callback makes them itself. It is right for any number of substeps, and
/// leaves torques alone that the app adds. To tell substeps apart it adds a torque of 0.12 N·m to the
/// fixed base, which moves nothing; an app that adds base torques from inside the tick would be in
/// its way. One controller at a time for a robot, which is borrowed and must outlive it.
class Controller {
 public:
  /// The work of one tick: the state and reference at its beginning, and the torque commanded for
  /// it.
  struct Tick {
    double time = 0.0;       // [s] since the controller was made
    int running = -1;        // index of the running primitive, -1 before the first
    Sample reference;        // n joints
    Eigen::VectorXd q, qd;   // n [rad], [rad/s]
    Eigen::VectorXd torque;  // n [N·m]
  };

  /// @throws Error  a coordinate is not a joint of the robot, a goal is outside a joint's limits, an
  ///                empty sequence, gains that are negative or not finite
  Controller(Robot& robot, const Sequence& sequence, const JoinSettings& join,
             const ControlSettings& settings = {});
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  ~Controller();

  /// @param dt  [s] Bullet's tick; nothing is done unless it is > 0
  void pre_tick(double dt) noexcept;

  /// The last switch has been due; the arm goes on to the last goal and stays there.
  bool finished() const noexcept { return sequencer_.finished(); }
  /// The sequence as it runs: for changing its goal, tau, amplitude and queue between ticks.
  Sequencer& sequencer() noexcept { return sequencer_; }
  const Sequencer& sequencer() const noexcept { return sequencer_; }
  const Tick& last_tick() const noexcept { return tick_; }

 private:
  friend class Plugin;

  void apply_torque() noexcept;

  Robot& robot_;
  std::vector<Eigen::Index> joints_;  // of each coordinate
  Sequencer sequencer_;
  ComputedTorque law_;
  Tick tick_;
  Eigen::VectorXd next_;      // n, reference position at the end of the tick
  double base_torque_ = 0.0;  // [N·m] on the base, as we left it
  bool marked_ = false;
  Eigen::VectorXd applied_;  // n [N·m] that of ours which still stands in the multibody
  Plugin* plugin_ = nullptr;
};

}  // namespace seam
