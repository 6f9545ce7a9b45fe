#pragma once

#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "never_meet.hpp"

class btCollisionWorld;

namespace seam {

/// A link's collider that Bullet does not check against others of its robot which it cannot meet where the joints are now.
class LinkCollider : public btMultiBodyLinkCollider {
 public:
  /// Borrows all of them.
  LinkCollider(const RobotModel& model, btMultiBody& multibody, int link, btCollisionWorld& world)
      : btMultiBodyLinkCollider(&multibody, link), model_(model), world_(world) {}

  /// Within the joints' limits, the two never meet.
  void never_meets(const LinkCollider& other, const TwoJoints& joints) {
    never_met_.push_back({&other, joints});
  }

  bool checkCollideWithOverride(const btCollisionObject* other) const override;

 private:
  struct NeverMet {
    const LinkCollider* other;
    TwoJoints joints;
  };
  bool is_within_limits(const NeverMet& pair) const;
  void forget_contacts(const LinkCollider& other) const;

  const RobotModel& model_;
  btCollisionWorld& world_;
  std::vector<NeverMet> never_met_;
};

}  // namespace seam
