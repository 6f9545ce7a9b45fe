#pragma once

#include <string>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/per_joint.hpp>
#include <seam/robot_model.hpp>

namespace SEAM_API seam {

/// When a controller no longer trusts the state that it sees, and when it no longer follows its sequence. Infinity
/// switches a bound off.
struct GuardSettings {
  PerJoint most_error =
      0.3;  // [rad or m] of a joint from its reference: a hit, or drives that are too weak
  /// Share of a joint's effort limit that the feedback must ask for besides, unless some drive is at its limit. A joint with friction
  /// may be far behind, but takes little torque to move; one that is lost takes all there is. 0, or a joint without an effort
  /// limit: the error alone counts.
  double least_effort = 0.5;
  double longest_dropout =
      0.1;  // [s] without a state that are bridged by the torque of the reference alone
  /// [rad or m] by which the reference moves while the state stays the same to the bit: then it is none. A state of rest (less than
  /// 1e-9 rad/s or m/s) is one until the reference has moved by most_error, if that is finite: friction may hold the arm.
  double frozen_beyond = 0.01;
  double beyond_limits =
      0.01;  // share of a joint's range by which the reference may pass its limits
};

/// What kept a controller from following its sequence.
struct Incident {
  /// Why.
  enum class Cause {
    none,
    no_state,     ///< the state was not finite, or frozen while the reference moved
    deviation,    ///< a joint was too far from its reference
    goal,         ///< a goal is beyond a joint's limits
    joint_limit,  ///< the sequence leads beyond a joint's limits
    unreachable,  ///< the tool cannot be where the sequence has it: out of reach, a limit, a singularity
  };

  Cause cause = Cause::none;  // why
  double time = 0.0;          // [s] since the controller was made; of no_state, when that began
  int joint = -1;             // of deviation, goal and joint_limit
  double value = 0.0;  // [s] without a state so far; [rad or m] deviation, goal, or reference
  double bound = 0.0;  // which it passed
};

/// The incident in one line, with the joint's name.
std::string describe(const Incident& incident, const RobotModel& robot);

/// Watches over n joints by GuardSettings. Neither allocates nor throws after construction.
class Guard {
 public:
  /// @param delay      [s] of the state, for which it may stay the same after a restart
  /// @param stiffness  n [N·m/rad or N/m] of the feedback, for least_effort; none: the error alone counts
  /// @throws Error  a bound is negative or NaN, or there are not as many as joints
  Guard(const RobotModel& model, const GuardSettings& settings, double delay = 0.0,
        const Eigen::VectorXd& stiffness = {});

  /// Once per tick: whether a state can be used.
  /// @param dt         [s] > 0
  /// @param reference  joint positions that the joints should have now
  bool trusts(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
              const Eigen::VectorXd& reference) noexcept;
  /// For how long there has been no state, and whether that is too long.
  Incident dropout() const noexcept;
  bool lost() const noexcept { return dropout_ > settings_.longest_dropout; }  // too long
  /// Starts watching anew, with the joints at q: those that are beyond a limit already may be led as far as that.
  void restart(const Eigen::VectorXd& q) noexcept;

  /// Which joint passes a bound, and with what; the cause is none where none does.
  /// @param limited  a drive could not give what it was asked for
  Incident deviation(const Eigen::VectorXd& q, const Eigen::VectorXd& reference,
                     bool limited) const noexcept;
  /// The same of a position that the joints should have.
  Incident beyond_limits(const Eigen::VectorXd& position) const noexcept;
  /// Moves the end of a motion back to a limit that it would pass; what is beyond one already may stay there.
  void keep_within_limits(const Eigen::VectorXd& from, Eigen::VectorXd& to) const noexcept;

 private:
  GuardSettings settings_;
  bool moved_beyond(const Eigen::VectorXd& reference) const noexcept;

  Eigen::VectorXd most_error_;        // n
  Eigen::VectorXd lost_error_;        // n, at which the feedback asks for least_effort, too
  Eigen::VectorXd least_, most_;      // n, what the reference may be
  Eigen::VectorXd seen_q_, seen_qd_;  // n, the last state that was new
  Eigen::VectorXd reference_;         // n, then
  Eigen::VectorXd lower_, upper_;     // n, the joints' limits
  Eigen::VectorXd slack_;             // n, by which they may be passed
  double delay_;
  double watched_ = 0.0;  // [s] since the restart
  bool begun_ = false;
  bool frozen_ = false;
  double dropout_ = 0.0;
};

}  // namespace seam
