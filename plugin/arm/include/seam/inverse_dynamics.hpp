#pragma once

#include <memory>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/precision.hpp>
#include <seam/robot_model.hpp>

namespace SEAM_API seam {

/// Inverse dynamics of a fixed-base robot by Bullet's `MultiBodyTree` (recursive Newton-Euler):
///     torque = M(q)·q̈ + h(q, q̇) − Jᵀ(q)·m·g   (summed over the bodies),
/// built from the model alone: it knows no btMultiBody and no world, so that a model that errs on
/// purpose (payload, mass) or a real arm is served by the same class. Move-only; allocates only
/// when made. The tree is also the workspace: one thread at a time.
class InverseDynamics {
 public:
  /// @throws Error  Bullet refuses a body (its parent does not come before it); Bullet's libraries of both precisions are
  ///                loaded
  explicit InverseDynamics(const RobotModel& model);
  InverseDynamics(InverseDynamics&&) noexcept;             // takes over the tree
  InverseDynamics& operator=(InverseDynamics&&) noexcept;  // likewise
  ~InverseDynamics();

  int dof() const noexcept;  // n joints
  /// Gravity [m/s²] in the frame of the root link; starts at (0, 0, -9.81).
  void set_gravity(const Eigen::Vector3d& gravity_in_base) noexcept;
  /// Joint torques [N·m] (forces [N] for prismatic joints) for q, q̇, q̈; dof values each.
  void torque(const Eigen::Ref<const Eigen::VectorXd>& q,
              const Eigen::Ref<const Eigen::VectorXd>& qd,
              const Eigen::Ref<const Eigen::VectorXd>& qdd,
              Eigen::Ref<Eigen::VectorXd> torque) const noexcept;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace seam
