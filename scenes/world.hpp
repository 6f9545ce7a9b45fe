#pragma once

#include <memory>

class btMultiBodyDynamicsWorld;

namespace seam {

/// An empty Bullet multibody world with its parts, gravity 9.81 m/s² along -z.
class World {
 public:
  World();
  ~World();

  btMultiBodyDynamicsWorld& operator*() noexcept;
  btMultiBodyDynamicsWorld* operator->() noexcept { return &**this; }

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seam
