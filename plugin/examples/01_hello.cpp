#include <iostream>

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <seam/bullet.hpp>
#include <seam/seam.hpp>

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -9.81));

  seam::Robot arm =
      seam::Robot::load("assets/pa10/pa10.urdf", world);  // urdfdom + assimp → btMultiBody
  auto reach = seam::learn(seam::Demonstration::read("assets/demos/ramp_up.csv"));
  auto back = seam::learn(seam::Demonstration::read("assets/demos/ramp_down.csv"));

  seam::Sequence task;
  task.then(reach).until(seam::before_end(0.4)).then(back);  // hand over 0.4 s before reach ends

  seam::Controller controller(arm, task, seam::Join::dmp3);
  seam::Plugin plugin(world);  // takes the world's pre-tick
  plugin.add(controller);      // any number of arms
  while (!controller.finished()) world.stepSimulation(1e-3, 0);
  std::cout << "elbow at " << controller.last_tick().q(3) << " rad\n";
}
