// Your own robot: any URDF of a fixed arm, standing anywhere. Every joint goes a tenth of its range away from the middle
// and comes back, handing over while it still moves; the program says how closely the joints followed. What comes after
// the URDF are folders in which to look for its packages.
//     own_robot robot.urdf [FOLDER...]

#include <algorithm>
#include <cmath>
#include <iostream>

#include "example.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

int main(int argc, char** argv) try {
  if (argc < 2) throw seam::Error("usage", "own_robot robot.urdf [FOLDER...]");
  World world;
  seam::RobotSettings place;  // on a tilted stand
  place.X_world_base.translate(Eigen::Vector3d(0.5, -0.2, 1.0));
  place.X_world_base.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  place.urdf.package_path.assign(argv + 2, argv + argc);
  place.self_collision = false;  // the shapes of some URDFs overlap
  seam::Robot arm = seam::Robot::load(argv[1], world.bullet, place);

  std::vector<std::string> names;
  std::vector<int> moved;
  Eigen::VectorXd middle = arm.model().neutral(), away = middle;
  for (int i = 0; i < arm.dof(); ++i) {
    const seam::Joint& joint = arm.model().joints[static_cast<std::size_t>(i)];
    if (joint.follows()) continue;  // a mimic joint: its leader takes it along
    const bool endless = std::isinf(joint.upper - joint.lower);
    middle(i) = endless ? 0.0 : 0.5 * (joint.lower + joint.upper);
    away(i) = middle(i) + (endless ? 0.5 : std::min(0.5, 0.1 * (joint.upper - joint.lower)));
    names.push_back(joint.name);
    moved.push_back(i);
  }
  arm.model().place_followers(middle);
  arm.reset(middle, Eigen::VectorXd::Zero(arm.dof()));

  seam::Sequence task;
  task.then(seam::learn(movement(names, middle(moved), away(moved), 1.5)))
      .until(seam::before_end(0.4))
      .then(seam::learn(movement(names, away(moved), middle(moved), 1.5)));
  seam::Controller controller(arm, task, seam::Join::dmp2j);
  seam::Plugin plugin(world.bullet);
  plugin.add(controller);

  double error = 0.0;
  while (!controller.finished()) {
    world.bullet.stepSimulation(btScalar(1e-3), 0);
    const auto& tick = controller.last_tick();
    error = std::max(error, (tick.q - tick.reference.position).lpNorm<Eigen::Infinity>());
  }
  std::cout << arm.model().name << ": " << arm.dof() << " joints followed to " << error
            << " rad or m\n";
  return error < (sizeof(btScalar) == 8 ? 1e-9 : 1e-5) ? 0 : 1;
} catch (const seam::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
