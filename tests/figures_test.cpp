// The figures that the methods were chosen by, calculated before this library was written: what a join costs, and what is
// left by the equations as they were printed.

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
double step_of(const Primitive& primitive, const Sample& at, double phase, const JoinSettings& join) {
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
    price.deviation =
        std::max(price.deviation,
                 std::abs(execution.sample().position(0) - dmp2.sample().position(0)));
  }
  return price;
}

TEST(Start, WithoutAJoinStepsByTheErrorOfTheFit) {
  // Printed .4 to 6 rad/s².
  const Primitive smooth = learned(test::minimum_jerk());
  const Primitive wiggling = learned(test::wiggle());
  std::printf("start %.3f %.3f\n", step_of(smooth, moving(smooth, 0.0), 1.0, Join::dmp2), step_of(wiggling, moving(wiggling, 0.0), 1.0, Join::dmp2));
  for (double w : {0.5,1.0}) std::printf("start %g %.3f %.3f\n", w, step_of(learned(test::minimum_jerk(),w), moving(smooth, 0.0), 1.0, Join::dmp2), step_of(learned(test::wiggle(),w), moving(wiggling, 0.0), 1.0, Join::dmp2));
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
  std::printf("dmp2j %.4f dmp3 %.4f dmp2a %.4f\n", price_of(primitive, at, Join::dmp2j).deviation, price_of(primitive, at, Join::dmp3).deviation,price_of(primitive, at, Join::dmp2a).deviation);
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

TEST(PrintedEquations, Print) {
  for (double w : {0.5, 0.75, 1.0})
    for (int which : {0, 1}) {
      const Primitive p = learned(which ? test::wiggle() : test::minimum_jerk(), w);
      for (auto [v, a] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.0, -20.0}})
        std::printf("w %g %s v %g a %g: 20: %.2f 22: %.2f\n", w, which ? "wiggle" : "mj", v, a,
                    printed_step(p, moving(p, v, a), 1.0, false), printed_step(p, moving(p, v, a), 1.0, true));
    }
  for (double amp : {0.1, 0.2, 0.3, 0.5})
   for (double T : {1.0, 1.2, 2.0}) {
    const Demonstration demo = test::demonstrate(3 * T, [&](double t) {
      const double q = 2 * M_PI / T;
      return Eigen::Vector3d(amp * sin(q * t), amp * q * cos(q * t), -amp * q * q * sin(q * t));
    });
    LearnSettings s; s.gains = Gains::paper(); s.kind = Kind::rhythmic; s.period = T;
    const Primitive p = learn(demo, s);
    for (double ph : {0.0, 1.0, 2.0})
      std::printf("T %g amp %g ph %g: 20 %.2f 22: %.2f ; v=.5 %.2f\n", T, amp, ph, printed_step(p, moving(p, 0.0), ph, false), printed_step(p, moving(p, 0), ph, true), printed_step(p, moving(p, 0.5), ph, true));
  }
}

}  // namespace
}  // namespace seam
