#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/inverse_kinematics.hpp>
#include <seam/join.hpp>
#include <seam/robot_model.hpp>
#include <seam/sequence.hpp>

namespace SEAM_API seam {

/// How far a tool is from where its sequence has it.
struct ToolError {
  double distance = 0.0;  // [m]
  double angle = 0.0;     // [rad]
};

/// What a sequence's coordinates are for the joints of a robot: turns its samples into joint references.
class JointReference {
 public:
  virtual ~JointReference() = default;

  /// The state of the sequence's coordinates while the joints are at (q, q̇), without acceleration.
  virtual Sample measured(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) = 0;
  /// The same, on the way: from wherever the joints are. Neither allocates nor throws.
  /// @return  false where the coordinates have no such state
  virtual bool take_up(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                       Sample& at) noexcept = 0;
  /// Joint positions at a goal of the sequence. Neither allocates nor throws.
  /// @return  false where only moving there tells
  virtual bool at_goal(const Eigen::Ref<const Eigen::VectorXd>& goal,
                       Eigen::VectorXd& joints) noexcept = 0;
  /// @throws Error  a goal of the sequence that the robot cannot reach
  virtual void require_reachable(const Primitive& primitive) = 0;
  /// @throws Error  a goal or a position that is wished which the robot cannot reach; of a tool those are looked at that
  ///                name x, y and z
  void require_reachable_step(const Sequence::Step& step);
  /// The joints' state for a sample of the sequence. Neither allocates nor throws.
  /// @return  false where there is none; `joints` is then left as it was
  virtual bool find(const Sample& sample, Sample& joints) noexcept = 0;
  /// How far the tool is from a sample of the sequence while the joints are at q; nothing in joint space.
  virtual ToolError miss(const Sample& sample, const Eigen::VectorXd& q) noexcept = 0;

 private:
  virtual bool moves_tool() const noexcept { return false; }
};

/// The followers among a robot's joints, and where a reference has them.
class Followers {
 public:
  explicit Followers(const RobotModel& robot);  // copies what it needs
  /// Position by multiplier and offset, velocity and acceleration by the multiplier. Neither allocates nor throws.
  void place(Sample& joints) const noexcept;
  /// Positions alone.
  void place(Eigen::VectorXd& position) const noexcept;

 private:
  struct Follower {
    Eigen::Index joint, leader;
    double multiplier, offset;
  };
  std::vector<Follower> followers_;
};

/// The coordinates are joints; those that are not named hold the position in which they were measured,
/// or follow their leaders.
class JointSpace final : public JointReference {
 public:
  /// @throws Error  a coordinate is not a joint of the robot, or one that follows another
  JointSpace(const RobotModel& robot, const std::vector<std::string>& coordinates);

  Sample measured(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) override;
  bool take_up(const Eigen::VectorXd& q, const Eigen::VectorXd& qd, Sample& at) noexcept override;
  bool at_goal(const Eigen::Ref<const Eigen::VectorXd>& goal,
               Eigen::VectorXd& joints) noexcept override;
  void require_reachable(const Primitive& primitive) override;
  bool find(const Sample& sample, Sample& joints) noexcept override;
  ToolError miss(const Sample&, const Eigen::VectorXd&) noexcept override { return {}; }

 private:
  std::vector<Eigen::Index> moved_by_;  // n, the coordinate that moves each joint, or none
  Eigen::VectorXd held_;                // n, where the joints were that are not named
  Followers followers_;
  std::vector<Eigen::Index> joints_;  // of each coordinate
  std::vector<Joint> all_;            // n
};

/// The tool that a task-space sequence moves, and the joints' posture while it does.
struct ToolSettings {
  std::string link;                                               // a URDF link of the robot
  Eigen::Isometry3d X_link_tool = Eigen::Isometry3d::Identity();  // the tool's frame in it
  /// In the base, kept where the sequence does not turn the tool; empty: that at the beginning.
  std::optional<Eigen::Quaterniond> orientation;
  PostureSettings posture;  // rest empty: where the joints are when the controller begins
  double most_speed =
      10.0;  // [rad/s or m/s] of a joint; beyond it, near a singularity, there is no reference
};

/// The coordinates are a tool's: x y z [m] in the frame of the robot's root link, and rx ry rz, the rotation vector about
/// the sequence's reference orientation (see orientation.hpp). Without the latter three the tool keeps
/// the orientation of its settings. Joints follow from InverseKinematics, exact in
/// velocity and acceleration too, and followers from their leaders; near a singularity the tool may be off by millimetres, which ToolError says.
class TaskSpace final : public JointReference {
 public:
  /// @param q  joint positions at the beginning
  /// @throws Error  other coordinates than x y z or x y z rx ry rz, rotation vectors without a reference orientation,
  ///                no such link, settings that do not fit the robot
  TaskSpace(const RobotModel& robot, const Sequence& sequence, const ToolSettings& tool,
            const Eigen::VectorXd& q);

  /// Joint positions at rest from which the sequence can begin with the tool at a pose.
  /// @throws Error  out of reach, by how much
  Eigen::VectorXd reach(const Eigen::Isometry3d& pose);
  /// The tool's pose for values of the coordinates.
  Eigen::Isometry3d pose(const Eigen::Ref<const Eigen::VectorXd>& position) const noexcept;

  /// @throws Error  the joints are not where the posture puts them (see `reach`)
  Sample measured(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) override;
  bool take_up(const Eigen::VectorXd& q, const Eigen::VectorXd& qd, Sample& at) noexcept override;
  bool at_goal(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::VectorXd&) noexcept override {
    return false;
  }
  void require_reachable(const Primitive& primitive) override;
  bool find(const Sample& sample, Sample& joints) noexcept override;
  ToolError miss(const Sample& sample, const Eigen::VectorXd& q) noexcept override;
  /// The tool's pose for joint positions. Neither allocates nor throws.
  Eigen::Isometry3d tool_at(const Eigen::VectorXd& q) const noexcept;

 private:
  bool moves_tool() const noexcept override { return true; }
  bool turns() const noexcept { return dimensions_ == 6; }
  bool state_at(const Eigen::VectorXd& q, const Eigen::VectorXd& qd, Sample& at) noexcept;
  bool to_tool(const Sample& sample) noexcept;
  bool follow_target() noexcept;

  int dimensions_;
  double most_speed_;
  Kinematics tool_;
  InverseKinematics solver_;
  Followers followers_;
  Eigen::Quaterniond reference_;  // q₀, or the orientation that is kept
  ToolState target_;
  Eigen::VectorXd target_at_;  // the coordinates of its pose
  JointSolution solution_;
  Eigen::VectorXd found_;  // n, the last position that `find` gave
};

}  // namespace seam
