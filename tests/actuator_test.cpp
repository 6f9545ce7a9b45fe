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

TEST(Actuator, RefusesALagThatCannotBe) {
  ActuatorSettings settings;
  settings.lag = -1.0;
  EXPECT_EQ(test::refusal([&] { Actuator(two_joints(), settings); }),
            "actuator: lag -1.000000 s, must be >= 0");
}

}  // namespace
}  // namespace seam
