#pragma once

#include <memory>

#include <seam/per_joint.hpp>
#include <seam/robot.hpp>

namespace seam {

/// Friction in the joints, on top of what else acts on them.
struct FrictionSettings {
  PerJoint viscous =
      0.0;  // [N·m·s/rad] b: torque −b·q̇, at the tick's beginning: stable while b·dt < 2 × inertia
  PerJoint coulomb =
      0.0;  // [N·m] c: at most c against the motion; a joint at rest sticks until more pulls
};

/// Friction in the first joints of a robot in Bullet, which is borrowed. Coulomb's is a motor of Bullet's in each joint
/// that wants it to stand and can do no more than c, so that it neither chatters nor depends on the tick. (Bullet leaves out
/// constraints of links without a collider.)
class Friction {
 public:
  /// @param joints  how many have it
  /// @throws Error  a setting is negative or not finite, or a link that has Coulomb friction has no collision shape
  Friction(Robot& robot, int joints, const FrictionSettings& settings);
  ~Friction();

  /// To be called once before each of Bullet's ticks of dt [s].
  void pre_tick(double dt) noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seam
