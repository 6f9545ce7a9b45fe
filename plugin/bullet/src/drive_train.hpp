#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <LinearMath/btAlignedObjectArray.h>
#include <LinearMath/btMatrix3x3.h>
#include <LinearMath/btVector3.h>

#include "stick_slip.hpp"
#include <seam/robot_model.hpp>

class btMultiBody;

namespace seam {

/// What stands between the drives and the bodies of a robot in Bullet: rotors J, friction b and c, springs k with dampers d. With
/// the drives' positions θ and velocities w (those of the joints, unless they are elastic), the drives' torques u, and t what
/// reaches the bodies, at the end of a tick of dt
///     J(w⁺ − w)/dt + b·w⁺ + c·sgn(w⁺) = u − t
///     t = k(θ − q) + (γ·k·dt + d)(w⁺ − q̇⁺)  of elastic joints; where they are rigid, t is what makes w⁺ = q̇⁺
///     q̇⁺ = q̇ + dt·q̈₀ + dt·W·t
/// where q̈₀ is the acceleration without t, and W = M⁻¹ of the joints that have any of it. Both come from Bullet's own articulated-body
/// algorithm, so that passive joints, forces on links and whatever else acts are in them. Friction is implicit: it is stable at
/// any tick, and a joint sticks. γ = ½·max(0, 1 − κ/k) with κ = 2/(dt²(1/J + Σⱼ|Wᵢⱼ|)): 0, with which a spring keeps its energy,
/// while the tick resolves it, and up to ½, with which it is stable at any k.
class DriveTrain {
 public:
  /// @throws Error  a value is negative or not finite (a stiffness: not > 0), an elastic joint has no rotor
  DriveTrain(const RobotModel& model, btMultiBody& multibody);

  DriveTrain(const DriveTrain&) = delete;
  DriveTrain& operator=(const DriveTrain&) = delete;

  bool is_there() const noexcept { return !joints_.empty(); }          // some joint has any of it
  const std::vector<int>& joints() const noexcept { return joints_; }  // that have
  /// Puts the drives to the joints' state, and springs to where they bear `torque` (n).
  void reset(const Eigen::VectorXd& torque);
  /// Replaces the state of joints that are elastic by that of their drives.
  void state_of_drives(Eigen::Ref<Eigen::VectorXd> q,
                       Eigen::Ref<Eigen::VectorXd> qd) const noexcept;
  /// One tick of dt. The joint torques that stand in the multibody are all others than those of the drives of joints().
  /// @param torque  n [N·m or N] of the drives; in those joints that have any of it replaced by what reaches the bodies
  void transmit(double dt, Eigen::VectorXd& torque) noexcept;

 private:
  Eigen::Index size() const noexcept { return static_cast<Eigen::Index>(joints_.size()); }  // m
  void ask_bullet() noexcept;
  void couple(double dt) noexcept;

  btMultiBody& multibody_;
  std::vector<int> joints_;  // m that have any of it
  Eigen::VectorXd J_, b_, c_, k_, d_;
  Eigen::VectorXd theta_, w_;       // of the drives; theta of elastic joints only
  Eigen::VectorXd qd_, qdd_;        // of the joints; without what the drives do
  Eigen::MatrixXd W_, P_, A_;       // see couple
  Eigen::VectorXd spring_, kappa_;  // k(θ − q); γ·k·dt + d, 1 where rigid
  Eigen::VectorXd free_, r_, t_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
  StickSlip stick_slip_;
  std::vector<btScalar> force_, response_;
  btAlignedObjectArray<btScalar> scratch_r_;
  btAlignedObjectArray<btVector3> scratch_v_;
  btAlignedObjectArray<btMatrix3x3> scratch_m_;
};

}  // namespace seam
