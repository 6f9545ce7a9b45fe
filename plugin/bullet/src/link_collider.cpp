#include "link_collider.hpp"

#include <algorithm>

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>

namespace seam {

bool LinkCollider::checkCollideWithOverride(const btCollisionObject* other) const {
  const auto pair = std::find_if(never_met_.begin(), never_met_.end(),
                                 [&](const NeverMet& p) { return p.other == other; });
  if (pair == never_met_.end() || !is_within_limits(*pair))
    return btMultiBodyLinkCollider::checkCollideWithOverride(other);
  forget_contacts(*pair->other);
  return false;
}

bool LinkCollider::is_within_limits(const NeverMet& pair) const {
  const auto& [first, second] = pair.joints;
  return pair.joints.are_within_limits(model_, m_multiBody->getJointPos(first),
                                       m_multiBody->getJointPos(second));
}

// That they had when joints were beyond their limits: Bullet keeps the contacts of a pair that it no longer looks at.
void LinkCollider::forget_contacts(const LinkCollider& other) const {
  if (!m_broadphaseHandle || !other.m_broadphaseHandle) return;  // not in the world
  btOverlappingPairCache& pairs = *world_.getPairCache();
  btBroadphasePair* const pair = pairs.findPair(m_broadphaseHandle, other.m_broadphaseHandle);
  if (pair && pair->m_algorithm) pairs.cleanOverlappingPair(*pair, world_.getDispatcher());
}

}  // namespace seam
