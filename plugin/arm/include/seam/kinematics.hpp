#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/robot_model.hpp>

namespace SEAM_API seam {

/// Linear part first, then angular: velocity [m/s, rad/s], acceleration, or wrench [N, N·m].
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// One column per joint.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Pose and Jacobian of one frame of a robot, in the frame of its base (URDF root link), and what the Jacobian's exact
/// derivatives do. With ωⱼ the axis of a revolute joint (0 for a prismatic one) and vⱼ what the joint
/// does to the frame's origin, column j of J is (vⱼ, ωⱼ), and for joint i before joint j
///     ∂vⱼ/∂qᵢ = ∂vᵢ/∂qⱼ = ωᵢ × vⱼ,   ∂ωⱼ/∂qᵢ = ωᵢ × ωⱼ,   ∂ωᵢ/∂qⱼ = 0
/// Joints that do not move the frame have columns of 0. Construction allocates; nothing after it does, nor throws.
class Kinematics {
 public:
  /// @param link         a URDF link of the model
  /// @param X_link_tool  pose of the frame in the link
  /// @throws Error  no such link, no joint moves it, or one that follows another does
  Kinematics(const RobotModel& model, const std::string& link,
             const Eigen::Isometry3d& X_link_tool = Eigen::Isometry3d::Identity());

  int dof() const noexcept { return static_cast<int>(jacobian_.cols()); }  // n joints

  /// The frame's pose at joint positions [rad or m], without going there.
  Eigen::Isometry3d pose_at(const Eigen::Ref<const Eigen::VectorXd>& q) const noexcept;

  /// Goes to joint positions [rad or m]; all that follows is for these.
  void move_to(const Eigen::Ref<const Eigen::VectorXd>& q) noexcept;
  /// The frame's pose.
  const Eigen::Isometry3d& X_base_tool() const noexcept { return X_base_tool_; }
  const Jacobian& jacobian() const noexcept { return jacobian_; }  // J
  /// d(Jᵀw)/dq for a constant wrench: element (j, i) is Σₖ wₖ ∂Jₖⱼ/∂qᵢ. dof × dof.
  void wrench_gradient(const Vector6d& wrench, Eigen::Ref<Eigen::MatrixXd> gradient) const noexcept;

  /// A wrench and its rate of change.
  struct MovingWrench {
    Vector6d value;  // w
    Vector6d rate;   // ẇ
  };
  /// While the joints move at constant velocities and w changes at a constant rate: d²(Jᵀw)/dt² = J̈ᵀw + 2J̇ᵀẇ, dof.
  /// @return  the frame's acceleration, J̇·q̇
  Vector6d move_on(const Eigen::Ref<const Eigen::VectorXd>& qd, const MovingWrench& wrench,
                   Eigen::Ref<Eigen::VectorXd> curvature) const noexcept;

 private:
  struct Link {
    Eigen::Index joint;
    bool prismatic;
    Eigen::Isometry3d X_before_joint;  // in the joint before; the z axis is the joint's
  };

  template <typename Visit>
  Eigen::Isometry3d walk(const Eigen::Ref<const Eigen::VectorXd>& q, Visit&& visit) const noexcept;

  std::vector<Link> chain_;        // from the base to the frame
  Eigen::Isometry3d X_last_tool_;  // in the last joint
  Eigen::Isometry3d X_base_tool_ = Eigen::Isometry3d::Identity();
  Jacobian jacobian_;
};

}  // namespace seam
