#pragma once

#include <cmath>
#include <string>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "scenes/world.hpp"
#include "tests/support.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

namespace seam::test {

/// A PA-10 that stands bent, and what its elbow can be told.

inline const std::string pa10 = std::string(SEAM_ASSETS) + "/pa10/pa10.urdf";

inline Eigen::VectorXd bent() {
  Eigen::VectorXd q(7);
  q << 0.2, 0.5, -0.3, 0.8, 0.4, 0.6, -0.1;
  return q;
}

/// At constant speed, in half a second.
inline Demonstration ramp(const std::string& joint, double from, double to) {
  Demonstration demo = demonstrate(0.5, [&](double t) {
    return Eigen::Vector3d(from + (to - from) * t / 0.5, (to - from) / 0.5, 0.0);
  });
  demo.coordinates = {joint};
  return demo;
}

/// Two ramps, to 1.1 and to 0.9 rad, after 0.05 s at rest.
inline Sequence elbow_task() {
  Sequence task;
  task.start_after(0.05).then(learn(ramp("E1", 0.8, 1.1))).then(learn(ramp("E1", 1.1, 0.9)));
  return task;
}

struct Arm {
  Robot robot;

  explicit Arm(World& world, const RobotSettings& settings = {})
      : robot(Robot::load(pa10, *world, settings)) {
    robot.reset(bent(), Eigen::VectorXd::Zero(7));
  }
};

/// How far the joints are from their reference.
inline double tracking_error(const Controller& controller) {
  const Controller::Tick& tick = controller.last_tick();
  return (tick.reference.position - tick.q).cwiseAbs().maxCoeff();
}

/// An arm with a controller in a world of its own.
struct App {
  World world;
  Arm arm{world};
  Controller controller;
  Plugin plugin{*world};

  explicit App(const Sequence& task, const ControllerSettings& settings = {},
               Join join = Join::dmp3)
      : controller(arm.robot, task, join, settings) {
    plugin.add(controller);
  }
  const Controller::Tick& step(double dt = 1e-3) {
    world->stepSimulation(dt, 0);
    return controller.last_tick();
  }
  void play(double seconds) {
    for (int k = 0; k < std::lround(seconds * 1000.0); ++k) step();
  }
  Eigen::VectorXd q() const {
    Eigen::VectorXd q(7), qd(7);
    arm.robot.state(q, qd);
    return q;
  }
};

}  // namespace seam::test
