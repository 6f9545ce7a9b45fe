// Task space: the hand of the PA-10 goes along a line and on upwards, and keeps its orientation.
//     task_space pa10.urdf

#include <algorithm>
#include <iostream>

#include "example.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

int main(int argc, char** argv) try {
  if (argc != 2) throw seam::Error("usage", "task_space pa10.urdf");
  World world;
  seam::Robot arm = seam::Robot::load(argv[1], world.bullet);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(arm.dof());
  q.head(7) << 0.0, 0.6, 0.0, 1.4, 0.0, 0.8, 0.0;  // away from the singular stretched arm
  arm.reset(q, Eigen::VectorXd::Zero(arm.dof()));

  seam::ToolSettings hand;
  hand.link = "tool";
  const Eigen::Vector3d here = arm.X_world_frame(arm.model().frame("tool")).translation();
  const Eigen::Vector3d along = here + Eigen::Vector3d(0.0, 0.15, 0.0);
  const Eigen::Vector3d up = along + Eigen::Vector3d(0.0, 0.0, 0.10);

  seam::Sequence task;
  task.then(seam::learn(movement({"x", "y", "z"}, here, along, 1.5)))
      .until(seam::before_end(0.5))
      .then(seam::learn(movement({"x", "y", "z"}, along, up, 1.5)));
  seam::Controller controller(arm, task, seam::Join::dmp3, {{}, hand});
  seam::Plugin plugin(world.bullet);
  plugin.add(controller);

  double miss = 0.0;
  for (int k = 0; k < 4000; ++k) {
    world.bullet.stepSimulation(btScalar(1e-3), 0);
    miss = std::max(miss, controller.last_tick().tool_error.distance);
  }
  const Eigen::Vector3d there = arm.X_world_frame(arm.model().frame("tool")).translation();
  std::cout << "the hand is " << (there - up).norm() << " m from its goal, and was " << miss
            << " m from its path at most\n";
  return controller.status() == seam::Controller::Status::following && miss < 1e-4 ? 0 : 1;
} catch (const seam::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
