#include <cmath>

#include <gtest/gtest.h>

#include "tests/support.hpp"
#include <seam/execution.hpp>

namespace seam {
namespace {

TEST(LongRun, PhaseOfARhythmDoesNotDrift) {
  std::mt19937_64 random(1);
  const Primitive primitive = test::random_primitive(random, 1, 20, Kind::rhythmic);
  Execution execution(primitive);
  const double before = execution.phase();
  for (int k = 0; k < 1'000'000; ++k) execution.step(1e-3);
  EXPECT_NEAR(execution.phase() - before, 1000.0 / primitive.tau, 2e-13 * 1000.0 / primitive.tau);
}

TEST(LongRun, AGoalIsHeldWithoutSubnormalNumbers) {
  std::mt19937_64 random(2);
  const Primitive primitive = test::random_primitive(random, 3, 10, Kind::discrete);
  for (const Join method : {Join::dmp2, Join::dmp2a, Join::dmp3, Join::dmp2j}) {
    Execution execution(primitive);
    execution.reinitialise(Sample::at_rest(primitive.start_position), 1.0, method);
    for (int k = 0; k < 10000; ++k) {
      execution.step(0.2 * primitive.tau);
      for (int d = 0; d < 3; ++d) {
        EXPECT_NE(std::fpclassify(execution.sample().velocity(d)), FP_SUBNORMAL);
        EXPECT_NE(std::fpclassify(execution.sample().acceleration(d)), FP_SUBNORMAL);
      }
      ASSERT_EQ(std::fpclassify(execution.phase()), FP_NORMAL);
    }
    EXPECT_EQ(execution.sample().position, primitive.goal);
  }
}

}  // namespace
}  // namespace seam
