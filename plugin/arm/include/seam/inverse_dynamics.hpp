#pragma once

#include <memory>
#include <thread>

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
/// when made.
///
/// Bullet's tree is also its workspace, of 10 kB for seven joints, and one thread may work in it at a time. Those that one
/// thread made of equal models work in one tree as long as that thread calls them, so that many arms of a kind fit into
/// the processor's caches; called by another thread, each works in a tree of its own.
class InverseDynamics {
 public:
  /// @throws Error  Bullet refuses a body (its parent does not come before it); Bullet's libraries of both precisions are
  ///                loaded
  explicit InverseDynamics(const RobotModel& model);
  InverseDynamics(InverseDynamics&&) noexcept;             // takes over the tree
  InverseDynamics& operator=(InverseDynamics&&) noexcept;  // likewise
  ~InverseDynamics();

  int dof() const noexcept { return dof_; }  // n joints
  /// Gravity [m/s²] in the frame of the root link; starts at (0, 0, -9.81).
  void set_gravity(const Eigen::Vector3d& gravity_in_base) noexcept { gravity_ = gravity_in_base; }
  /// Joint torques [N·m] (forces [N] for prismatic joints) for q, q̇, q̈; dof values each.
  void torque(const Eigen::Ref<const Eigen::VectorXd>& q,
              const Eigen::Ref<const Eigen::VectorXd>& qd,
              const Eigen::Ref<const Eigen::VectorXd>& qdd,
              Eigen::Ref<Eigen::VectorXd> torque) const noexcept;

 private:
  struct Tree;
  Tree& tree() const noexcept;

  std::shared_ptr<Tree> shared_;  // of all of equal models that made_by_ made
  std::thread::id made_by_;
  std::unique_ptr<Tree> own_;  // for other threads
  Eigen::Vector3d gravity_{0.0, 0.0, -9.81};
  int dof_;
};

}  // namespace seam
