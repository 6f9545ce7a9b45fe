#include <complex>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include "tests/wheel.hpp"
#include <seam/computed_torque.hpp>

namespace seam {
namespace {

using test::inertia;
using test::one;
using test::wheel;

struct Case {
  double Kp, Kd;
};

// Creeping, critical, swinging, undamped, a drag alone, nothing.
constexpr Case cases[] = {{100.0, 90.0}, {400.0, 40.0}, {400.0, 4.0},
                          {400.0, 0.0},  {0.0, 40.0},   {0.0, 0.0}};

TickGains gains(const Case& c, double dt) {
  return {c.Kp, c.Kd, dt};
}

// The poles of e' = e + dt·v', v' = v − dt(Kd'v + Kp'e) are those of ë = −Kd·ė − Kp·e over dt.
TEST(TickGains, MoveThePolesWhereTheEquationHasThem) {
  using Complex = std::complex<double>;
  for (const Case& c : cases)
    for (const double dt : {1e-4, 1e-3, 1e-2, 0.05, 0.1}) {
      const TickGains tick = gains(c, dt);
      const double trace = 2.0 - dt * tick.Kd - dt * dt * tick.Kp;
      const double determinant = 1.0 - dt * tick.Kd;
      const Complex root = std::sqrt(Complex(0.25 * c.Kd * c.Kd - c.Kp));
      const Complex fast = std::exp((-0.5 * c.Kd - root) * dt);
      const Complex slow = std::exp((-0.5 * c.Kd + root) * dt);
      EXPECT_NEAR(trace, (fast + slow).real(), 1e-14) << c.Kp << " " << c.Kd << " " << dt;
      EXPECT_NEAR(determinant, (fast * slow).real(), 1e-14) << c.Kp << " " << c.Kd << " " << dt;
    }
}

TEST(TickGains, AreTheGainsThemselvesAsTheTickGoesToZero) {
  for (const Case& c : cases) {
    EXPECT_NEAR(gains(c, 1e-6).Kp, c.Kp, 1e-4 * c.Kp) << c.Kp << " " << c.Kd;
    EXPECT_NEAR(gains(c, 1e-6).Kd, c.Kd, 1e-4 * c.Kd) << c.Kp << " " << c.Kd;
  }
}

TEST(TickGains, AreFiniteHoweverStiff) {
  for (const Case& c : {Case{1e12, 1e3}, Case{1e3, 1e12}, Case{1e12, 1e12}})
    for (const double dt : {1e-6, 0.1}) {
      EXPECT_TRUE(std::isfinite(gains(c, dt).Kp)) << c.Kp << " " << c.Kd;
      EXPECT_TRUE(std::isfinite(gains(c, dt).Kd)) << c.Kp << " " << c.Kd;
    }
}

// At a constant acceleration of 10 rad/s², with ticks as they come; what the wheel does is integrated as Bullet does.
struct Wheel {
  ComputedTorque law{wheel(), {}, one(0.0)};
  double time = 0.0;
  Eigen::VectorXd q = one(0.0), qd = one(0.0), torque = one(0.0);

  static Sample reference(double t) {
    Sample sample(1);
    sample.position = one(5.0 * t * t);
    sample.velocity = one(10.0 * t);
    sample.acceleration = one(10.0);
    return sample;
  }
  double error() const { return std::abs(q(0) - reference(time).position(0)); }
  void tick(double dt) {
    law.torque(dt, q, qd, reference(time), reference(time + dt).position, torque);
    qd += dt * torque / inertia;
    q += dt * qd;
    time += dt;
  }
};

TEST(ComputedTorque, DoesNotStepWhereTheTickChangesTenfold) {
  for (const auto& [before, after] : {std::pair{1e-3, 1e-2}, {1e-2, 1e-3}}) {
    Wheel wheel;
    for (int k = 0; k < 100; ++k) wheel.tick(before);
    EXPECT_NEAR(wheel.torque(0), 10.0 * inertia, 1e-9);
    EXPECT_LT(wheel.error(), 1e-12);
    double farthest = 0.0;
    for (int k = 0; k < 800; ++k) {
      wheel.tick(after);
      EXPECT_NEAR(wheel.torque(0), 10.0 * inertia, 0.2 * 10.0 * inertia);
      farthest = std::max(farthest, wheel.error());
    }
    EXPECT_LT(farthest, 1e-3);  // 9 ms · 10 rad/s² / 2 in velocity, over Kd/2·e
    EXPECT_LT(wheel.error(), 1e-6);
  }
}

TEST(ComputedTorque, FollowsTicksThatVaryWithoutAJerk) {
  Wheel wheel;
  for (int k = 0; k < 1000; ++k) {
    wheel.tick(k % 3 ? 1.0e-3 : 1.2e-3);
    if (k == 0) continue;  // half of the acceleration, from a velocity that is exact
    EXPECT_NEAR(wheel.torque(0), 10.0 * inertia, 0.01 * 10.0 * inertia) << k;
    EXPECT_LT(wheel.error(), 5e-5) << k;
  }
}

TEST(ComputedTorque, WithoutAStateIsThatOfTheReference) {
  Wheel wheel, blind;
  for (int k = 0; k < 100; ++k) wheel.tick(1e-3), blind.tick(1e-3);
  const Sample now = Wheel::reference(wheel.time);
  const Eigen::VectorXd next = Wheel::reference(wheel.time + 1e-3).position;
  Eigen::VectorXd torque = one(0.0);
  const AllocationGuard guard;
  blind.law.torque(1e-3, now, next, torque);
  EXPECT_EQ(guard.allocations(), 0);
  wheel.tick(1e-3);
  EXPECT_NEAR(torque(0), wheel.torque(0), 1e-9);
}

// A wheel with a rotor and friction that the model knows, or not: what its torque is, by hand.
TEST(ComputedTorque, MakesUpForRotorsAndFriction) {
  RobotModel model = wheel();
  model.joints[0].rotor_inertia = 0.05;
  model.joints[0].damping = 3.0;
  model.joints[0].friction = 2.0;
  ControlSettings settings;
  settings.friction_share = 0.7;
  ComputedTorque law(model, settings, one(0.0));
  Eigen::VectorXd torque = one(0.0);
  const Sample now = Wheel::reference(0.001);
  const double next_velocity = (Wheel::reference(0.002).position(0) - now.position(0)) / 1e-3;
  law.start(one(next_velocity - 10.0 * 1e-3));
  law.torque(1e-3, now.position, one(next_velocity - 10.0 * 1e-3), now,
             Wheel::reference(0.002).position, torque);
  EXPECT_NEAR(
      torque(0),
      (inertia + 0.05) * 10.0 + 0.7 * (3.0 * next_velocity + 2.0 * std::tanh(next_velocity / 0.02)),
      1e-9);
}

TEST(ComputedTorque, HasGainsPerJoint) {
  RobotModel model = wheel();
  model.joints.push_back(model.joints[0]);
  model.bodies.push_back(model.bodies[0]);
  ControlSettings settings;
  settings.Kp = Eigen::VectorXd(Eigen::Vector2d(100.0, 900.0));
  settings.Kd = Eigen::VectorXd(Eigen::Vector2d(0.0, 0.0));
  ComputedTorque law(model, settings, Eigen::Vector2d::Zero());
  const Sample rest = Sample::at_rest(Eigen::Vector2d::Zero());
  Eigen::VectorXd torque = Eigen::Vector2d::Zero();
  const Eigen::VectorXd off = Eigen::Vector2d(-1e-3, -1e-3);
  law.torque(1e-6, off, rest.velocity, rest, rest.position, torque);
  EXPECT_NEAR(torque(1) / torque(0), 9.0, 1e-3);
}

TEST(ComputedTorque, RefusesSettingsThatAreNone) {
  const auto refused = [](const auto& set) {
    ControlSettings settings;
    set(settings);
    return test::refusal([&] { ComputedTorque(wheel(), settings, one(0.0)); });
  };
  EXPECT_EQ(refused([](ControlSettings& settings) { settings.Kp = -1.0; }),
            "controller: gain Kp: -1.000000, must be >= 0");
  EXPECT_EQ(refused([](ControlSettings& settings) {
              settings.Kd = Eigen::VectorXd(Eigen::Vector3d::Ones());
            }),
            "controller: gain Kd: 3 numbers, must be 1, one for each joint");
  EXPECT_EQ(refused([](ControlSettings& settings) { settings.friction_share = NAN; }),
            "controller: friction_share nan, must be >= 0");
  EXPECT_EQ(refused([](ControlSettings& settings) { settings.friction_velocity = 0.0; }),
            "controller: friction_velocity 0, must be > 0");
  EXPECT_EQ(refused([](ControlSettings& settings) { settings.observer = -1.0; }),
            "controller: observer -1 rad/s, must be >= 0");
  EXPECT_EQ(refused([](ControlSettings& settings) { settings.most_correction = INFINITY; }),
            "controller: most_correction inf, must be >= 0");
}

}  // namespace
}  // namespace seam
