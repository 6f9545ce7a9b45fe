#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include "tests/wheel.hpp"
#include <seam/arm.hpp>
#include <seam/disturbance_observer.hpp>

namespace seam::test {

namespace {

constexpr double dt = 1e-3;

// Of a constant disturbance, 1 − exp(−ωt) is found after t, whatever the tick.
TEST(DisturbanceObserver, FindsADisturbanceWithItsBandwidth) {
  for (const double tick : {1e-4, 1e-3, 5e-3}) {
    DisturbanceObserver observer(50.0, one(100.0));
    double qd = 0.0;
    for (int k = 0; k <= std::lround(0.02 / tick); ++k) {
      observer.observe(tick, one(7.0), one(qd));
      qd += tick * (7.0 - 3.0);
    }
    EXPECT_NEAR(observer.correction()(0), 3.0 * -std::expm1(-50.0 * 0.02), 1e-9) << tick;
  }
}

TEST(DisturbanceObserver, IsBounded) {
  DisturbanceObserver observer(50.0, one(2.0));
  for (int k = 0; k < 1000; ++k) observer.observe(dt, one(1e6 * (k < 500 ? 1 : -1)), one(0.0));
  EXPECT_EQ(observer.correction()(0), -2.0);
}

TEST(DisturbanceObserver, HoldsOverATickThatSaysNothingAndBeginsAnewAtZero) {
  DisturbanceObserver observer(50.0, one(100.0));
  for (int k = 0; k < 100; ++k) observer.observe(dt, one(3.0), one(0.0));
  const double found = observer.correction()(0);
  EXPECT_GT(found, 2.9);
  observer.hold();
  observer.observe(dt, one(3.0), one(70.0));
  EXPECT_EQ(observer.correction()(0), found);
  observer.reset();
  EXPECT_EQ(observer.correction()(0), 0.0);
  observer.observe(dt, one(3.0), one(70.0));
  EXPECT_EQ(observer.correction()(0), 0.0);
}

// White noise of the velocity makes one of ω·σ·sqrt(2/(2 − ω·dt)): a first-order high-pass is what is left of differences.
TEST(DisturbanceObserver, PassesNoiseOnlyAsTheFeedbackDoes) {
  const double omega = 60.0, sigma = 1e-3;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, sigma);
  DisturbanceObserver observer(omega, one(1e9));
  double squares = 0.0;
  const int ticks = 200000;
  for (int k = 0; k < ticks; ++k) {
    observer.observe(dt, one(0.0), one(noise(random)));
    squares += std::pow(observer.correction()(0), 2);
  }
  const double share = -std::expm1(-omega * dt);
  EXPECT_NEAR(std::sqrt(squares / ticks), sigma * share / dt * std::sqrt(2.0 / (2.0 - share)),
              0.02 * sigma * omega);
}

// A wheel whose axle brakes with a torque that nobody told the controller of.
struct Braked {
  explicit Braked(double observer) : law(wheel(), settings(observer), one(0.0)) {}
  static ControlSettings settings(double observer) {
    ControlSettings settings;
    settings.observer = observer;
    return settings;
  }
  void tick(double disturbance) {
    Eigen::VectorXd torque = one(0.0);
    law.torque(dt, one(q), one(qd), rest, rest.position, torque);
    qd += dt * (torque(0) - disturbance) / inertia;
    q += dt * qd;
  }

  ComputedTorque law;
  Sample rest = Sample::at_rest(one(0.0));
  double q = 0.0, qd = 0.0;
};

TEST(DisturbanceObserver, TakesAwayWhatTheFeedbackLeaves) {
  Braked without(0.0), with(60.0);
  for (int k = 0; k < 1000; ++k) without.tick(2.0), with.tick(2.0);
  EXPECT_NEAR(without.q, -2.0 / (inertia * 400.0), 1e-3);
  EXPECT_NEAR(with.q, 0.0, 1e-6);
  EXPECT_NEAR(with.law.observer().correction()(0), 2.0 / inertia, 1e-6);
}

// Nothing is learned while the drive is at its limit: what was found before stays.
TEST(DisturbanceObserver, DoesNotWindUpWhereADriveIsLimited) {
  RobotModel model = wheel();
  model.joints[0].effort = 1.0;
  ArmControllerSettings settings;
  settings.law.observer = 60.0;
  settings.actuator.limit_effort = true;
  Demonstration stay = demonstrate(1.0, [](double) { return Eigen::Vector3d::Zero(); });
  stay.coordinates = {"turn"};
  Sequence task;
  task.then(learn(stay));
  ArmController controller(model, task, Join::dmp3, settings, one(0.0), one(0.0));
  double q = 0.0, qd = 0.0, most = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double push = k < 50 ? 3.0 : 0.0;
    const double torque = controller.tick(dt, one(q), one(qd))(0);
    qd += dt * (torque - push) / inertia;
    q += dt * qd;
    if (k >= 50) most = std::max(most, q);
  }
  EXPECT_LT(most, 0.05);  // overshoot, once it is let go of
  EXPECT_NEAR(q, 0.0, 1e-3);
}

TEST(DisturbanceObserver, AllocatesNothing) {
  Braked wheel(60.0);
  Eigen::VectorXd torque = one(0.0);
  const Eigen::VectorXd q = one(0.1), qd = one(0.2);
  const AllocationGuard guard;
  for (int k = 0; k < 3; ++k) {
    wheel.law.torque(dt, q, qd, wheel.rest, wheel.rest.position, torque);
    wheel.law.torque(dt, wheel.rest, wheel.rest.position, torque);
    wheel.law.hold_observer();
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace

}  // namespace seam::test
