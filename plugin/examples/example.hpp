#pragma once

// What the examples in Bullet share: a world, and a movement from here to there.

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include "movement.hpp"

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld bullet{&dispatcher, &broadphase, &solver, &configuration};

  World() { bullet.setGravity(btVector3(0, 0, btScalar(-9.81))); }
};
