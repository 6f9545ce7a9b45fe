// Goal from a sensor: a camera sees the target better the nearer the arm comes, and the goal follows what it sees without
// a step in torque. `set_goal` may be called between any two ticks.
//     goal_from_a_sensor pa10.urdf

#include <iostream>
#include <random>

#include "example.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

int main(int argc, char** argv) try {
  if (argc != 2) throw seam::Error("usage", "goal_from_a_sensor pa10.urdf");
  World world;
  seam::Robot arm = seam::Robot::load(argv[1], world.bullet);
  const std::vector<std::string> joints{"S1", "E1"};
  const Eigen::Vector2d here(0.0, 0.0), expected(0.5, 1.0), target(0.6, 1.2);

  seam::Sequence task;
  task.then(seam::learn(movement(joints, here, expected, 2.0)));
  seam::Controller controller(arm, task, seam::Join::dmp3);
  seam::Plugin plugin(world.bullet);
  plugin.add(controller);

  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  for (int k = 0; k < 4000; ++k) {
    if (k % 33 == 0 && k < 1800) {  // thirty pictures a second, until shortly before the end
      const double distance = (target - controller.sequencer().sample().position).norm();
      const Eigen::Vector2d seen = target + 0.02 * distance * Eigen::Vector2d(noise(random), 1.0);
      controller.sequencer().set_goal(seen);
    }
    world.bullet.stepSimulation(btScalar(1e-3), 0);
  }
  const Eigen::VectorXd& q = controller.last_tick().q;
  const double error =
      (Eigen::Vector2d(q(arm.model().joint("S1")), q(arm.model().joint("E1"))) - target).norm();
  std::cout << "the arm is " << error << " rad from the target\n";
  return error < 0.01 ? 0 : 1;
} catch (const seam::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
