#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "scenes/world.hpp"
#include <seam/robot.hpp>

namespace seam::test {

/// One step of Bullet's, the robot's drives at its beginning, where gravity acts already.
inline void drive_step(World& world, Robot& robot, const Eigen::VectorXd& torque, double dt) {
  struct Drive {
    Robot& robot;
    const Eigen::VectorXd& torque;
  } drive{robot, torque};
  world->setInternalTickCallback(
      [](btDynamicsWorld* of, btScalar substep) {
        const Drive& now = *static_cast<Drive*>(of->getWorldUserInfo());
        now.robot.drive(substep, now.torque);
      },
      &drive, true);
  world->stepSimulation(dt, 0);
}

}  // namespace seam::test
