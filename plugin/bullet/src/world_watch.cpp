#include "world_watch.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace seam {

WorldWatch::WorldWatch(btCollisionWorld& world) : world_(world) {
  mark_.setCollisionShape(&nothing_);
  mark_.setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT |
                          btCollisionObject::CF_NO_CONTACT_RESPONSE |
                          btCollisionObject::CF_DISABLE_VISUALIZE_OBJECT);
  world_.addCollisionObject(&mark_, 0, 0);
}

WorldWatch::~WorldWatch() {
  if (world_is_there()) world_.removeCollisionObject(&mark_);
}

}  // namespace seam
