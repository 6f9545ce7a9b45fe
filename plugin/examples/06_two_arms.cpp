// Two arms in one world, each with a sequence and a method of its own; the second follows half a second behind.
//     two_arms pa10.urdf

#include <iostream>

#include "example.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

namespace {

seam::Robot arm_at(const std::string& urdf, double y, World& world) {
  seam::RobotSettings place;
  place.X_world_base.translate(Eigen::Vector3d(0.0, y, 0.0));
  return seam::Robot::load(urdf, world.bullet, place);
}

seam::Sequence nod(const seam::Primitive& down, const seam::Primitive& up, double delay) {
  seam::Sequence task;
  task.start_after(delay).then(down).until(seam::before_end(0.3)).then(up);
  return task;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw seam::Error("usage", "two_arms pa10.urdf");
  World world;
  seam::Robot left = arm_at(argv[1], 0.8, world);
  seam::Robot right = arm_at(argv[1], -0.8, world);

  const Eigen::VectorXd straight = Eigen::VectorXd::Zero(1), bent = Eigen::VectorXd::Ones(1);
  const auto down = seam::learn(movement({"E1"}, straight, bent, 1.0));
  const auto up = seam::learn(movement({"E1"}, bent, straight, 1.0));
  seam::Controller first(left, nod(down, up, 0.0), seam::Join::dmp3);
  seam::Controller second(right, nod(down, up, 0.5), seam::Join::dmp2j);
  seam::Plugin plugin(world.bullet);
  plugin.add(first);
  plugin.add(second);

  double first_done = 0.0, second_done = 0.0;
  for (double time = 0.0; !first.finished() || !second.finished(); time += 1e-3) {
    world.bullet.stepSimulation(btScalar(1e-3), 0);
    if (!first.finished()) first_done = time;
    if (!second.finished()) second_done = time;
  }
  std::cout << "done after " << first_done << " s and " << second_done << " s\n";
  return second_done - first_done > 0.49 && second_done - first_done < 0.51 ? 0 : 1;
} catch (const seam::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
