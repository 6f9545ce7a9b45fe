// The figures that the methods were chosen by, calculated before this library was written: what a join costs, and what is
// left by the equations as they were printed.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "tests/joins.hpp"
#include "tests/ode.hpp"
#include "tests/support.hpp"
#include "tests/wiggle.hpp"
#include <seam/execution.hpp>
#include <seam/learn.hpp>

namespace seam {
namespace {

Primitive learned(const Demonstration& demo, double width = 0.75) {
  LearnSettings settings;
  settings.gains = Gains::paper();
  settings.width = width;
  return learn(demo, settings);
}

// Where a demonstration begins, but moving.
Sample moving(const Primitive& primitive, double velocity, double acceleration = 0.0) {
  Sample at = Sample::at_rest(primitive.start_position);
  at.velocity(0) = velocity;
  at.acceleration(0) = acceleration;
  return at;
}

// The step in acceleration at a join.
double step_of(const Primitive& primitive, const Sample& at, double phase,
               const JoinSettings& join) {
  Execution execution(primitive);
  execution.reinitialise(at, phase, join);
  return execution.sample().acceleration(0) - at.acceleration(0);
}

// Peak jerk and largest distance from dmp2.
struct Price {
  double jerk = 0.0, deviation = 0.0;
};

Price price_of(const Primitive& primitive, const Sample& at, const JoinSettings& join) {
  constexpr double dt = 1e-4;
  Execution execution(primitive);
  Execution dmp2(primitive);
  execution.reinitialise(at, 1.0, join);
  dmp2.reinitialise(at, 1.0, Join::dmp2);
  Price price;
  for (double t = 0.0; t < 2.0; t += dt) {
    execution.step(dt);
    dmp2.step(dt);
    price.jerk = std::max(price.jerk, std::abs(execution.state().jerk(0)));
    price.deviation = std::max(
        price.deviation, std::abs(execution.sample().position(0) - dmp2.sample().position(0)));
  }
  return price;
}

TEST(Start, WithoutAJoinStepsByTheErrorOfTheFit) {
  std::vector<double> steps;
  for (const Demonstration& demo : {test::minimum_jerk(), test::wiggle()})
    for (const double width : {0.75, 1.0}) {
      const Primitive primitive = learned(demo, width);
      steps.push_back(std::abs(step_of(primitive, moving(primitive, 0.0), 1.0, Join::dmp2)));
      for (const JoinSettings& join : test::continuous_methods) {
        EXPECT_LT(std::abs(step_of(primitive, moving(primitive, 0.0), 1.0, join)), 1e-11);
      }
    }
  EXPECT_NEAR(*std::min_element(steps.begin(), steps.end()), 0.4, 0.05);
  EXPECT_NEAR(*std::max_element(steps.begin(), steps.end()), 6.0, 0.5);
}

TEST(Join, Dmp2StepsByTheDampingOfTheVelocity) {
  const Primitive primitive = learned(test::minimum_jerk());
  const double at_rest = step_of(primitive, moving(primitive, 0.0), 1.0, Join::dmp2);
  const double step = step_of(primitive, moving(primitive, 0.5), 1.0, Join::dmp2);
  EXPECT_NEAR(step - at_rest, -28.0 * 0.5, 1e-12);
  EXPECT_NEAR(step, -15.0, 0.5);
}

struct Priced {
  const char* name;
  JoinSettings join;
  double peak_jerk;  // [rad/s³]
  double deviation;  // [rad]
};

class JoinPrice : public testing::TestWithParam<Priced> {};

TEST_P(JoinPrice, IsAsCalculatedIndependently) {
  const Primitive primitive = learned(test::minimum_jerk());
  const Price price = price_of(primitive, moving(primitive, 0.5), GetParam().join);
  EXPECT_NEAR(price.jerk, GetParam().peak_jerk, 1.0);
  EXPECT_NEAR(price.deviation, GetParam().deviation, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    , JoinPrice,
    testing::Values(Priced{"Dmp3", Join::dmp3, 151.0, 0.021},
                    Priced{"Dmp2aFirst", {Join::dmp2a, WeightChange::first}, 73.0, 0.024},
                    Priced{"Dmp2aSmallest", Join::dmp2a, 59.0, 0.029},
                    Priced{"Dmp2j", Join::dmp2j, 44.0, 0.035}),
    [](const auto& priced) { return std::string(priced.param.name); });

TEST(Join, JerkStepsAsCalculatedIndependently) {
  const Primitive primitive = learned(test::minimum_jerk());
  const auto jerk_step = [&](Join method) {
    Execution execution(primitive);
    execution.reinitialise(moving(primitive, 0.5), 1.0, method);
    return execution.state().jerk(0);
  };
  EXPECT_NEAR(jerk_step(Join::dmp3), -152.0, 1.0);
  EXPECT_NEAR(jerk_step(Join::dmp2a), -31.0, 1.0);
  EXPECT_NEAR(jerk_step(Join::dmp2j), 0.0, 1e-9);
}

TEST(Join, PriceOfJerkContinuityRisesWithTheAccelerationThatComesIn) {
  const Primitive primitive = learned(test::minimum_jerk());
  const Sample at = moving(primitive, 1.0, -20.0);
  EXPECT_NEAR(price_of(primitive, at, Join::dmp2j).deviation, 0.10, 5e-3);
  EXPECT_NEAR(price_of(primitive, at, Join::dmp2a).deviation, 0.02, 5e-3);
}

// The weight that Eqs. 20 and 22 give as they are printed, for the first kernel or the strongest.
double printed_step(const Primitive& primitive, const Sample& at, double phase, bool strongest) {
  const test::Ode ode(primitive);
  const Eigen::VectorXd psi = ode.kernels(phase).cast<double>();
  Eigen::Index k = 0;
  if (strongest) psi.maxCoeff(&k);
  const double others = primitive.weights.col(0).dot(psi) - primitive.weights(k, 0) * psi(k);
  const double needed = primitive.tau * primitive.tau * at.acceleration(0) +
                        primitive.tau * primitive.gains.D * at.velocity(0) -
                        primitive.gains.K * (primitive.goal(0) - at.position(0));
  Primitive edited = primitive;
  edited.weights(k, 0) = needed - others / psi.sum();
  if (strongest) edited.weights(k, 0) /= psi(k);
  return step_of(edited, at, phase, Join::dmp2);
}

// Discrete, at its beginning. The corrected forms leave nothing there.
TEST(PrintedEquations, LeaveAStepAtTheBeginning) {
  std::vector<double> steps;
  for (const Demonstration& demo : {test::minimum_jerk(), test::wiggle()})
    for (const double width : {0.5, 0.75, 1.0}) {
      const Primitive primitive = learned(demo, width);
      for (const double velocity : {0.0, 0.5, 1.0})
        for (const double acceleration : {0.0, -20.0}) {
          const Sample at = moving(primitive, velocity, acceleration);
          steps.push_back(printed_step(primitive, at, 1.0, false));
          EXPECT_NEAR(printed_step(primitive, at, 1.0, true), steps.back(), 1e-9);
          for (const WeightChange change : {WeightChange::first, WeightChange::strongest}) {
            EXPECT_LT(std::abs(step_of(primitive, at, 1.0, {Join::dmp2a, change})), 1e-11);
          }
        }
    }
  EXPECT_NEAR(*std::min_element(steps.begin(), steps.end()), 6.9, 0.05);
  EXPECT_NEAR(*std::max_element(steps.begin(), steps.end()), 44.3, 0.05);
}

Primitive sine(double amplitude, double period) {
  const double w = 2.0 * M_PI / period;
  const Demonstration demo = test::demonstrate(3.0 * period, [&](double t) {
    return Eigen::Vector3d(amplitude * std::sin(w * t), amplitude * w * std::cos(w * t),
                           -amplitude * w * w * std::sin(w * t));
  });
  LearnSettings settings;
  settings.gains = Gains::paper();
  settings.kind = Kind::rhythmic;
  settings.period = period;
  return learn(demo, settings);
}

// Rhythmic, 0.1 rad in 1 s, from rest at its centre. Between two kernels no one of them is 1, and it is worse.
TEST(PrintedEquations, LeaveAStepInARhythm) {
  const Primitive primitive = sine(0.1, 1.0);
  const Sample rest = Sample::at_rest(Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(printed_step(primitive, rest, 0.0, true), 56.4, 0.05);
  EXPECT_NEAR(printed_step(primitive, rest, 1.0, true), 373.5, 0.05);
  for (const double phase : {0.0, 1.0})
    EXPECT_LT(std::abs(step_of(primitive, rest, phase, {Join::dmp2a, WeightChange::strongest})),
              1e-10);
}

// A rhythm of 0.3 rad in 2 s, entered from rest: weights that stay changed bend every cycle by 0.04 rad; put back at once
// they leave a step, for a tenth of a cycle one of more than 5 rad/s². Worked out by the independent solution.
TEST(RhythmicUndo, IsNeededAndCannotBeDoneAtOnce) {
  const Primitive primitive = sine(0.3, 2.0);
  const test::Ode::Matrix rest = test::Ode::Matrix::Zero(1, 4);
  test::Ode kept(primitive);
  test::Ode learned(primitive);
  kept.join(rest, 0.0L, Join::dmp2a);
  learned.join(rest, 0.0L, Join::dmp2);
  kept.weights += kept.change;
  kept.change.setZero();
  double bend = 0.0;
  for (int k = 0; k < 400; ++k) {
    if (k <= 20) {
      test::Ode put_back = kept;
      put_back.weights = learned.weights;
      EXPECT_GT(std::abs(static_cast<double>((put_back.motion() - kept.motion())(0, 2))), 5.0);
    }
    kept.advance(0.01L, 100);
    learned.advance(0.01L, 100);
    if (k >= 200)
      bend =
          std::max(bend, std::abs(static_cast<double>((kept.motion() - learned.motion())(0, 0))));
  }
  EXPECT_NEAR(bend, 0.04, 5e-3);
}

// Blended, the undo adds nothing to the peak of the jerk: that is where the weights stay changed.
TEST(RhythmicUndo, AddsNoPeakJerk) {
  const Primitive primitive = sine(0.3, 2.0);
  const test::Ode::Matrix rest = test::Ode::Matrix::Zero(1, 4);
  test::Ode kept(primitive);
  kept.join(rest, 0.0L, Join::dmp2a);
  kept.weights += kept.change;
  kept.change.setZero();
  Execution blended(primitive);
  blended.reinitialise(Sample::at_rest(Eigen::VectorXd::Zero(1)), 0.0, Join::dmp2a);
  double peak_kept = 0.0;
  double peak_blended = 0.0;
  for (int k = 0; k < 1000; ++k) {
    peak_kept = std::max(peak_kept, std::abs(static_cast<double>(kept.motion()(0, 3))));
    peak_blended = std::max(peak_blended, std::abs(blended.state().jerk(0)));
    kept.advance(1e-3L, 20);
    blended.step(1e-3);
  }
  EXPECT_LT(peak_blended, 1.001 * peak_kept);
}

// A goal that moves by 0.1 rad at tau = 1: second order steps in acceleration by K·Δg/τ² and is there first (t90 0.27 s),
// third order steps in jerk by K·H·Δg/τ³ and takes 0.37 s.
double time_to_90_percent(Join method) {
  Primitive primitive = learn(test::minimum_jerk());
  primitive.weights.setZero();
  Execution execution(primitive);
  execution.reinitialise(Sample::at_rest(primitive.goal), 1.0, method);
  execution.set_goal(primitive.goal.array() + 0.1);
  double t = 0.0;
  for (; execution.sample().position(0) < primitive.goal(0) + 0.09; t += 1e-3) execution.step(1e-3);
  return t;
}

TEST(ChangeOfGoal, StepsAndSettlesAsTheEquationsSay) {
  Primitive primitive = learn(test::minimum_jerk());
  primitive.weights.setZero();
  Execution execution(primitive);
  const auto change_goal = [&](Join method) {
    execution.set_goal(primitive.goal);
    execution.reinitialise(Sample::at_rest(primitive.goal), 1.0, method);
    execution.set_goal(primitive.goal.array() + 0.1);
  };
  change_goal(Join::dmp2);
  EXPECT_NEAR(execution.sample().acceleration(0), 20.0, 1e-12);
  change_goal(Join::dmp3);
  EXPECT_NEAR(execution.state().jerk(0), 200.0 * std::sqrt(200.0) * 0.1, 1e-9);
  // (1 + u)exp(−u) = 0.1 and (1 + u + u²/2)exp(−u) = 0.1 with u = √K·t/τ.
  EXPECT_NEAR(time_to_90_percent(Join::dmp2), 3.88972 / std::sqrt(200.0), 1e-3);
  EXPECT_NEAR(time_to_90_percent(Join::dmp3), 5.32232 / std::sqrt(200.0), 1e-3);
}

// At 0.4 of a minimum-jerk movement a change of tau from 1 to 0.7 that kept v would make ẏ = v/τ jump by 0.74 rad/s.
TEST(ChangeOfTau, KeepsTheVelocityAndNotTheScaledOne) {
  Execution execution(learned(test::minimum_jerk()));
  for (int k = 0; k < 400; ++k) execution.step(1e-3);
  const double velocity = execution.sample().velocity(0);
  ASSERT_TRUE(execution.set_tau(0.7));
  EXPECT_EQ(execution.sample().velocity(0), velocity);
  EXPECT_NEAR(velocity / 0.7 - velocity, 0.74, 5e-3);
}

// Largest error over 1.5 s of the wiggling movement.
struct IntegrationError {
  double quadratic = 0.0, linear = 0.0;  // in the forcing over a step
};

IntegrationError integration_error(double dt) {
  const Primitive primitive = learned(test::wiggle());
  const Gains& g = primitive.gains;
  test::Ode exact(primitive);
  Execution execution(primitive);
  // y and ẏ under a forcing that is linear over the step, which is a quadratic with its middle half-way.
  const Propagator step(g, primitive.tau, dt);
  Eigen::Vector2d linear(primitive.start_position(0) - primitive.goal(0),
                         primitive.start_velocity(0));
  const auto forcing = [&](double t) {
    const double x = std::exp(-primitive.alpha * t / primitive.tau);
    const Eigen::VectorXd psi = exact.kernels(x).cast<double>();
    return x * psi.dot(primitive.weights.col(0)) / psi.sum();
  };
  IntegrationError worst;
  const int ticks = static_cast<int>(std::lround(1.5 / dt));
  for (int k = 0; k < ticks; ++k) {
    const double start = forcing(k * dt);
    const double end = forcing((k + 1) * dt);
    linear = (step.Phi.topLeftCorner<2, 2>() * linear +
              step.Gamma * Eigen::Vector3d(start, 0.5 * (start + end), end))
                 .eval();
    execution.step(dt);
    exact.advance(dt, static_cast<int>(std::lround(dt / 5e-5)));
    const auto y = static_cast<double>(exact.motion()(0, 0));
    worst.quadratic = std::max(worst.quadratic, std::abs(execution.sample().position(0) - y));
    worst.linear = std::max(worst.linear, std::abs(linear(0) + primitive.goal(0) - y));
  }
  return worst;
}

TEST(Integration, OfAQuadraticForcingIsOfFourthOrderAndOfALinearOneOfSecond) {
  const IntegrationError fine = integration_error(1e-3);
  const IntegrationError coarse = integration_error(1e-2);
  EXPECT_NEAR(fine.quadratic, 1.4e-11, 0.1e-11);
  EXPECT_NEAR(coarse.quadratic, 1.4e-7, 0.1e-7);
  EXPECT_NEAR(fine.linear, 4e-6, 0.5e-6);
  EXPECT_NEAR(coarse.linear, 4e-4, 0.5e-4);
}

}  // namespace
}  // namespace seam
