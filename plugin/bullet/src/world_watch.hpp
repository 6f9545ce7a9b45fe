#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btEmptyShape.h>

class btCollisionWorld;

namespace seam {

/// Tells whether a world is still there. Bullet tells nobody when a world is destroyed, but takes every collision object
/// that is in it out of its broadphase: this puts one there, without a shape and in no collision group, which nothing
/// meets, no ray hits and no step moves. Allocates when made.
class WorldWatch {
 public:
  explicit WorldWatch(btCollisionWorld& world);
  WorldWatch(const WorldWatch&) = delete;
  WorldWatch& operator=(const WorldWatch&) = delete;
  ~WorldWatch();

  bool world_is_there() const noexcept { return mark_.getBroadphaseHandle() != nullptr; }

 private:
  btCollisionWorld& world_;
  btEmptyShape nothing_;
  btCollisionObject mark_;
};

}  // namespace seam
