#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/ode.hpp"
#include "tests/support.hpp"
#include <seam/execution.hpp>

namespace seam {
namespace {

// Largest distance from an independent solution after a join to a moving start, relative to the range of the motion.
double worst_error(const Primitive& primitive, double dt, double duration, Join method) {
  Execution execution(primitive);
  Sample at(primitive.dimensions());
  at.position = primitive.start_position;
  at.velocity = primitive.start_velocity;
  at.acceleration.setConstant(2.0);
  const double phase = primitive.kind == Kind::rhythmic ? 0.7 : 1.0;
  execution.reinitialise(at, phase, method);
  std::vector<test::Ode> solutions;
  for (int d = 0; d < primitive.dimensions(); ++d) {
    solutions.emplace_back(primitive, d, at.position(d), at.velocity(d), phase);
    if (method == Join::dmp3) solutions.back().join_dmp3(2.0L);
    if (method == Join::dmp2a) solutions.back().join_dmp2a(2.0L);
  }
  double worst = 0.0;
  double low = at.position(0);
  double high = low;
  for (double t = dt; t < duration; t += dt) {
    execution.step(dt);
    for (int d = 0; d < primitive.dimensions(); ++d) {
      test::Ode& solution = solutions[static_cast<std::size_t>(d)];
      solution.advance(dt, static_cast<int>(std::lround(dt / 1e-4)));
      const double y = execution.sample().position(d);
      worst = std::max(worst, std::abs(y - static_cast<double>(solution.y)));
      low = std::min(low, y), high = std::max(high, y);
    }
  }
  return worst / (high - low);
}

class ExecutionOf : public testing::TestWithParam<std::tuple<Kind, Join>> {};

TEST_P(ExecutionOf, AgreesWithAnIndependentSolution) {
  const auto [kind, method] = GetParam();
  std::mt19937_64 random(4);
  for (int i = 0; i < 3; ++i) {
    const Primitive primitive =
        test::random_primitive(random, 2, kind == Kind::rhythmic ? 20 : 10, kind);
    EXPECT_LT(worst_error(primitive, 1e-3, 1.5, method), 1e-9) << "seed 4, primitive " << i;
  }
}

TEST_P(ExecutionOf, HasAnErrorOfFourthOrderInTheStep) {
  const auto [kind, method] = GetParam();
  std::mt19937_64 random(6);
  const Primitive primitive = test::random_primitive(random, 1, 10, kind);
  const double coarse = worst_error(primitive, 8e-3, 0.8, method);
  const double fine = worst_error(primitive, 4e-3, 0.8, method);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.4);
}

INSTANTIATE_TEST_SUITE_P(, ExecutionOf,
                         testing::Combine(testing::Values(Kind::discrete, Kind::rhythmic),
                                          testing::Values(Join::dmp2, Join::dmp2a, Join::dmp3)),
                         [](const auto& of) {
                           return std::string(std::get<0>(of.param) == Kind::discrete
                                                  ? "Discrete"
                                                  : "Rhythmic") +
                                  std::string(to_string(std::get<1>(of.param)));
                         });

TEST(Execution, IsStableForAnyStep) {
  std::mt19937_64 random(7);
  const Primitive primitive = test::random_primitive(random, 3);
  for (const double dt : {0.05, 0.5, 5.0, 500.0}) {
    Execution execution(primitive);
    for (double t = 0.0; t < 60.0 * primitive.tau; t += dt) execution.step(dt);
    EXPECT_LT((execution.sample().position - primitive.goal).cwiseAbs().maxCoeff(), 1e-3) << dt;
  }
}

TEST(Execution, VelocityAndAccelerationAreDerivativesOfThePosition) {
  std::mt19937_64 random(8);
  Execution execution(test::random_primitive(random, 1));
  const double h = 1e-4;
  for (int i = 0; i < 50; ++i) {
    const Sample a = execution.sample();
    execution.step(h);
    const Sample b = execution.sample();
    execution.step(h);
    const Sample c = execution.sample();
    EXPECT_NEAR(b.velocity(0), (c.position(0) - a.position(0)) / (2.0 * h), 1e-5);
    EXPECT_NEAR(b.acceleration(0), (c.velocity(0) - a.velocity(0)) / (2.0 * h), 1e-3);
  }
}

TEST(Execution, StepsAndReinitialisesWithoutAllocating) {
  std::mt19937_64 random(9);
  const Primitive primitive = test::random_primitive(random, 7, 20, Kind::rhythmic);
  Execution execution(primitive);
  const Sample at = Sample::at_rest(primitive.start_position);
  const Eigen::VectorXd goal = primitive.goal;
  const AllocationGuard guard;
  for (const Join method : all_joins) {
    execution.reinitialise(at, 1.0, method);
    for (int i = 0; i < 10; ++i) execution.step(i < 5 ? 1e-3 : 2e-3);
    execution.set_goal(goal);
    execution.set_tau(0.3);
    execution.set_amplitude(1.2);
    execution.step(1e-3);
    execution.least_correction_phase(at);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
