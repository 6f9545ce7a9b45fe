#pragma once

#include <vector>

#include <Eigen/Core>

#include <seam/computed_torque.hpp>
#include <seam/robot.hpp>
#include <seam/sequencer.hpp>

namespace seam {

class Plugin;

/// Plays a sequence of joint-space primitives on a robot in Bullet. The sequence's coordinates are
/// joint names; joints that it does not name hold the position they have now.
///
/// Once per Bullet tick, before the forces are used, `pre_tick(dt)` reads the state, advances the
/// sequence by dt, and adds the computed torque to the joints. `Plugin` makes those calls; an app
/// that owns its tick callback makes them itself. It is right for any number of substeps, and
/// leaves torques alone that the app adds. The robot is borrowed and must outlive the controller.
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

  /// @throws Error  a coordinate is not a joint of the robot, a goal is outside a joint's limits,
  /// an empty sequence,
  ///                gains that are negative or not finite
  Controller(Robot& robot, const Sequence& sequence, Join method,
             const ControlSettings& settings = {});
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  ~Controller();

  void pre_tick(double dt) noexcept;

  /// The last switch has been due; the controller goes on holding the last goal.
  bool finished() const noexcept { return sequencer_.finished(); }
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
  Eigen::VectorXd next_;     // n, reference position at the end of the tick
  Eigen::VectorXd applied_;  // n [N·m] that of ours which still stands in the multibody
  Plugin* plugin_ = nullptr;
};

}  // namespace seam
