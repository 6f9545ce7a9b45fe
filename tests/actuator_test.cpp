#include <cmath>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/actuator.hpp>

namespace seam {
namespace {

RobotModel two_joints() {
  RobotModel model;
  model.joints.resize(2);
  model.bodies.resize(2);
  model.joints[0].effort = 10.0;
  model.joints[1].effort = 4.0;
  return model;
}

TEST(Actuator, IsIdealUnlessToldOtherwise) {
  Actuator actuator(two_joints(), {});
  EXPECT_EQ(actuator.deliver(1e-3, Eigen::Vector2d(3.0, -50.0)), Eigen::Vector2d(3.0, -50.0));
  EXPECT_EQ(actuator.deliver(1e-3, Eigen::Vector2d(-7.0, 0.0)), Eigen::Vector2d(-7.0, 0.0));
}

TEST(Actuator, DeliversNoMoreThanItsEffort) {
  ActuatorSettings settings;
  settings.limit_effort = true;
  Actuator actuator(two_joints(), settings);
  EXPECT_EQ(actuator.deliver(1e-3, Eigen::Vector2d(11.0, -50.0)), Eigen::Vector2d(10.0, -4.0));
}

// The closed form of a first-order lag's answer to a step, at any tick.
TEST(Actuator, LagsByItsTimeConstant) {
  ActuatorSettings settings;
  settings.lag = 0.02;
  for (const double dt : {1e-3, 7e-3}) {
    Actuator actuator(two_joints(), settings);
    EXPECT_EQ(actuator.deliver(dt, Eigen::Vector2d(1.0, 2.0)), Eigen::Vector2d(1.0, 2.0));
    for (int k = 1; k <= 20; ++k) {
      const AllocationGuard guard;
      const Eigen::VectorXd& delivered = actuator.deliver(dt, Eigen::Vector2d(5.0, -2.0));
      const double left = std::exp(-k * dt / 0.02);
      EXPECT_NEAR(delivered(0), 5.0 - 4.0 * left, 1e-13);
      EXPECT_NEAR(delivered(1), -2.0 + 4.0 * left, 1e-13);
    }
  }
}

// A step of 5 at 100 a second is a ramp of 50 ms, whatever the tick.
TEST(Actuator, ChangesNoFasterThanItsRate) {
  ActuatorSettings settings;
  settings.rate = 100.0;
  for (const double dt : {1e-3, 2.5e-3}) {
    Actuator actuator(two_joints(), settings);
    actuator.deliver(dt, Eigen::Vector2d::Zero());
    for (int k = 1; k * dt < 0.06; ++k) {
      const Eigen::VectorXd& delivered = actuator.deliver(dt, Eigen::Vector2d(5.0, -0.15));
      EXPECT_NEAR(delivered(0), std::min(5.0, 100.0 * k * dt), 1e-12);
      EXPECT_NEAR(delivered(1), -std::min(0.15, 100.0 * k * dt), 1e-12);
    }
  }
}

TEST(Actuator, DeliversMultiplesOfItsQuantum) {
  ActuatorSettings settings;
  settings.quantum = Eigen::VectorXd(Eigen::Vector2d(0.5, 0.0));
  Actuator actuator(two_joints(), settings);
  for (const auto& [commanded, delivered] :
       {std::pair{0.24, 0.0}, {0.26, 0.5}, {-1.2, -1.0}, {3.0, 3.0}})
    EXPECT_EQ(actuator.deliver(1e-3, Eigen::Vector2d(commanded, commanded)),
              Eigen::Vector2d(delivered, commanded));
}

TEST(Actuator, DoesOneThingAfterTheOther) {
  ActuatorSettings settings;
  settings.quantum = 1.0;
  settings.limit_effort = true;
  settings.rate = 2000.0;
  settings.lag = 0.01;
  Actuator actuator(two_joints(), settings);
  actuator.deliver(1e-3, Eigen::Vector2d::Zero());
  const double share = -std::expm1(-0.1);
  EXPECT_NEAR(actuator.deliver(1e-3, Eigen::Vector2d(99.0, 1.4))(0), 2.0 * share, 1e-12);
  for (int k = 0; k < 1000; ++k) actuator.deliver(1e-3, Eigen::Vector2d(99.0, 1.4));
  EXPECT_NEAR(actuator.deliver(1e-3, Eigen::Vector2d(99.0, 1.4))(0), 10.0, 1e-12);
  EXPECT_NEAR(actuator.deliver(1e-3, Eigen::Vector2d(99.0, 1.4))(1), 1.0, 1e-12);
}

TEST(Actuator, RefusesWhatCannotBe) {
  const auto refused = [](const std::function<void(ActuatorSettings&)>& spoil) {
    ActuatorSettings settings;
    spoil(settings);
    return test::refusal([&] { Actuator(two_joints(), settings); });
  };
  EXPECT_EQ(refused([](auto& s) { s.lag = -1.0; }), "actuator: lag: -1.000000, must be >= 0");
  EXPECT_EQ(refused([](auto& s) { s.quantum = NAN; }), "actuator: quantum: nan, must be >= 0");
  EXPECT_EQ(refused([](auto& s) { s.lag = Eigen::VectorXd(Eigen::Vector3d::Zero()); }),
            "actuator: lag: 3 numbers, must be 2, one for each joint");
  for (const double rate : {0.0, -1.0, static_cast<double>(NAN)})
    EXPECT_EQ(refused([&](auto& s) { s.rate = rate; }),
              "actuator: rate: must be a number > 0 [N·m/s], or one for each joint");
}

}  // namespace
}  // namespace seam
