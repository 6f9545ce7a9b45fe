#include <cmath>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/sensor.hpp>

namespace seam {
namespace {

RobotModel two_joints() {
  RobotModel model;
  model.joints.resize(2);
  model.bodies.resize(2);
  return model;
}

Eigen::Vector2d q_at(double t) {
  return {3.0 * t, -t};
}
const Eigen::Vector2d qd(3.0, -1.0);

TEST(Sensor, IsIdealUnlessToldOtherwise) {
  Sensor sensor(two_joints(), {});
  EXPECT_TRUE(sensor.ideal());
  sensor.measure(1e-3, q_at(0.3), qd);
  EXPECT_EQ(sensor.q(), q_at(0.3));
  EXPECT_EQ(sensor.qd(), qd);
}

// Of a motion at constant speed, at ticks that are no multiples of the delay; nothing is allocated on the way.
TEST(Sensor, IsLateByItsDelay) {
  SensorSettings settings;
  settings.delay = 0.0125;
  Sensor sensor(two_joints(), settings);
  EXPECT_FALSE(sensor.ideal());
  double t = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double dt = k % 3 ? 1e-3 : 2e-3;
    const AllocationGuard guard;
    sensor.measure(dt, q_at(t), qd);
    EXPECT_NEAR(sensor.q()(0), q_at(std::max(0.0, t - 0.0125))(0), 1e-9);
    EXPECT_EQ(sensor.qd(), qd);
    t += dt;
  }
}

TEST(Sensor, RemembersNoMoreThanItsTicks) {
  SensorSettings settings;
  settings.delay = 10.0;
  Sensor sensor(two_joints(), settings);
  for (int k = 0; k < 3000; ++k) sensor.measure(1e-3, q_at(1e-3 * k), qd);
  EXPECT_NEAR(sensor.q()(0), q_at(1e-3 * (2999 - Sensor::most_ticks + 1))(0), 1e-9);
}

TEST(Sensor, RoundsPositionsToItsResolution) {
  SensorSettings settings;
  settings.resolution = Eigen::VectorXd(Eigen::Vector2d(0.25, 0.0));
  Sensor sensor(two_joints(), settings);
  sensor.measure(1e-3, Eigen::Vector2d(0.9, 0.9), qd);
  EXPECT_EQ(sensor.q(), Eigen::Vector2d(1.0, 0.9));
  EXPECT_EQ(sensor.qd(), qd);
}

TEST(Sensor, AddsWhiteNoiseOfItsStandardDeviation) {
  SensorSettings settings;
  settings.position_noise = 1e-3;
  settings.velocity_noise = Eigen::VectorXd(Eigen::Vector2d(0.0, 0.5));
  Sensor sensor(two_joints(), settings), again(two_joints(), settings);
  settings.seed = 1;
  Sensor other(two_joints(), settings);
  constexpr int ticks = 20000;
  double square = 0.0, speed = 0.0, mean = 0.0, next = 0.0, before = 0.0;
  for (int k = 0; k < ticks; ++k) {
    for (Sensor* each : {&sensor, &again, &other}) each->measure(1e-3, q_at(1.0), qd);
    const double error = sensor.q()(0) - 3.0;
    mean += error / ticks;
    square += error * error / ticks;
    next += error * before / ticks;
    before = error;
    speed += std::pow(sensor.qd()(1) + 1.0, 2) / ticks;
    ASSERT_EQ(sensor.q(), again.q());
    ASSERT_NE(sensor.q(), other.q());
    ASSERT_EQ(sensor.qd()(0), 3.0);
  }
  EXPECT_NEAR(mean, 0.0, 4e-3 / std::sqrt(ticks));
  EXPECT_NEAR(std::sqrt(square), 1e-3, 3e-5);
  EXPECT_NEAR(std::sqrt(speed), 0.5, 0.015);
  EXPECT_NEAR(next, 0.0, 4e-6 / std::sqrt(ticks));
}

// Ticks of 10 ms: none from the third to the fourth, the state of the sixth from then on to the eighth.
TEST(Sensor, LosesTheStateInDropouts) {
  SensorSettings settings;
  settings.dropouts = {{0.02, 0.04, Dropout::What::missing}, {0.06, 0.08, Dropout::What::frozen}};
  Sensor sensor(two_joints(), settings);
  EXPECT_FALSE(sensor.ideal());
  const Eigen::VectorXd speed = qd;
  for (int k = 0; k < 12; ++k) {
    const Eigen::VectorXd q = q_at(0.01 * k);
    const AllocationGuard guard;
    sensor.measure(0.01, q, speed);
    EXPECT_EQ(guard.allocations(), 0);
    if (k == 2 || k == 3)
      EXPECT_TRUE(sensor.q().array().isNaN().all() && sensor.qd().array().isNaN().all()) << k;
    else
      EXPECT_EQ(sensor.q(), q_at(0.01 * (k == 6 || k == 7 ? 5 : k))) << k;
  }
}

TEST(Sensor, ForgetsWhatWasBefore) {
  SensorSettings settings;
  settings.delay = 0.005;
  Sensor sensor(two_joints(), settings);
  for (int k = 0; k < 20; ++k) sensor.measure(1e-3, q_at(1e-3 * k), qd);
  sensor.forget();
  for (int k = 0; k < 4; ++k) {
    sensor.measure(1e-3, q_at(5.0), qd);
    EXPECT_EQ(sensor.q(), q_at(5.0));
  }
}

TEST(Sensor, RefusesWhatCannotBe) {
  const auto refused = [](const std::function<void(SensorSettings&)>& spoil) {
    SensorSettings settings;
    spoil(settings);
    return test::refusal([&] { Sensor(two_joints(), settings); });
  };
  EXPECT_EQ(refused([](auto& s) { s.delay = -0.1; }), "sensor: delay: -0.100000 s, must be >= 0");
  EXPECT_EQ(
      refused([](auto& s) {
        s.dropouts = {{0.5, 0.5, Dropout::What::frozen}};
      }),
      "sensor: dropout: from 0.500000 s to 0.500000 s, must end after it began, at 0 or later");
  EXPECT_EQ(refused([](auto& s) { s.position_noise = -1.0; }),
            "sensor: position noise: -1.000000, must be >= 0");
  EXPECT_EQ(refused([](auto& s) { s.velocity_noise = INFINITY; }),
            "sensor: velocity noise: inf, must be >= 0");
  EXPECT_EQ(refused([](auto& s) { s.resolution = Eigen::VectorXd(Eigen::VectorXd::Ones(5)); }),
            "sensor: resolution: 5 numbers, must be 2, one for each joint");
}

}  // namespace
}  // namespace seam
