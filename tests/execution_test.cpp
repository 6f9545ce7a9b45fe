#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/ode.hpp"
#include "tests/support.hpp"
#include <seam/execution.hpp>

namespace seam {
namespace {

double worst_error(const Primitive& primitive, double dt, double duration,
                   double filtered_goal_shift) {
  Execution execution(primitive);
  std::vector<test::Ode> solutions;
  Sample at(primitive.dimensions());
  at.position = primitive.start_position;
  at.velocity = primitive.start_velocity;
  for (int d = 0; d < primitive.dimensions(); ++d) {
    solutions.emplace_back(primitive, d, at.position(d), at.velocity(d));
    solutions.back().r += filtered_goal_shift;
    at.acceleration(d) = static_cast<double>(solutions.back().acceleration());
  }
  if (filtered_goal_shift != 0.0) execution.reinitialise(at, 1.0, Join::dmp3);
  double worst = 0.0;
  for (double t = dt; t < duration; t += dt) {
    execution.step(dt);
    for (int d = 0; d < primitive.dimensions(); ++d) {
      test::Ode& solution = solutions[static_cast<std::size_t>(d)];
      solution.advance(dt, std::max(2, static_cast<int>(dt / 2e-4)));
      worst = std::max(worst,
                       std::abs(execution.sample().position(d) - static_cast<double>(solution.y)));
    }
  }
  return worst;
}

TEST(Execution, AgreesWithAnIndependentSolutionOfTheSecondOrderSystem) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(worst_error(test::random_primitive(random, 2), 1e-3, 1.5, 0.0), 1e-9)
        << "seed 4, primitive " << i;
}

TEST(Execution, AgreesWithAnIndependentSolutionOfTheThirdOrderSystem) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(worst_error(test::random_primitive(random, 2), 1e-3, 1.5, 0.3), 1e-9)
        << "seed 5, primitive " << i;
}

TEST(Execution, ErrorFallsWithTheFourthPowerOfTheStep) {
  std::mt19937_64 random(6);
  const Primitive primitive = test::random_primitive(random, 1);
  const double coarse = worst_error(primitive, 8e-3, 1.0, 0.0);
  const double fine = worst_error(primitive, 4e-3, 1.0, 0.0);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.3);
}

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
  const Primitive primitive = test::random_primitive(random, 7);
  Execution execution(primitive);
  const Sample at = Sample::at_rest(primitive.start_position);
  const AllocationGuard guard;
  for (const Join method : all_joins) {
    execution.reinitialise(at, 1.0, method);
    for (int i = 0; i < 10; ++i) execution.step(i < 5 ? 1e-3 : 2e-3);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
