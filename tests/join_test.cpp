#include <algorithm>

#include <gmock/gmock.h>

#include "tests/joins.hpp"
#include "tests/support.hpp"
#include <seam/execution.hpp>
#include <seam/join.hpp>

namespace seam {
namespace {

using test::continuous_methods;
using test::largest;
using test::rhythm;

constexpr double dt = 1e-3;

// Every kind of predecessor, left anywhere, against every kind of successor, entered anywhere.
using Pair = std::tuple<Kind, Kind>;

class JoinOfKinds : public testing::TestWithParam<Pair> {
 protected:
  static constexpr int cases = 200;

  // A predecessor somewhere on its way, itself joined to a random state, so that it may be in any transient.
  static Sample left_by_a_predecessor(std::mt19937_64& random, Kind kind) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Execution predecessor(
        test::random_primitive(random, 3, 8 + static_cast<int>(9.0 * uniform(random)), kind));
    Sample at = predecessor.sample();
    at.velocity *= 2.0 * uniform(random);
    predecessor.reinitialise(at, predecessor.basis().start_phase(),
                             continuous_methods[static_cast<std::size_t>(5.0 * uniform(random))]);
    predecessor.step(predecessor.tau() * 2.0 * uniform(random));
    return predecessor.state();
  }

  static double random_entry(std::mt19937_64& random, Kind kind) {
    std::uniform_real_distribution<double> phase(0.0, 2.0 * M_PI);
    return kind == Kind::rhythmic ? phase(random) : 1.0;
  }
};

TEST_P(JoinOfKinds, ContinuesPositionAndVelocityWithEveryMethod) {
  const auto [from, to] = GetParam();
  std::mt19937_64 random(10);
  for (int i = 0; i < cases; ++i) {
    const Sample at = left_by_a_predecessor(random, from);
    Execution successor(test::random_primitive(random, 3, 10, to));
    for (const Join method : all_joins) {
      successor.reinitialise(at, random_entry(random, to), method);
      EXPECT_LT(largest(successor.sample().position - at.position), 1e-14) << "seed 10, case " << i;
      EXPECT_EQ(successor.sample().velocity, at.velocity);
    }
  }
}

TEST_P(JoinOfKinds, ContinuesAccelerationWithEveryMethodButDmp2) {
  const auto [from, to] = GetParam();
  std::mt19937_64 random(11);
  for (int i = 0; i < cases; ++i) {
    const Sample at = left_by_a_predecessor(random, from);
    Execution successor(test::random_primitive(random, 3, 10, to));
    for (const JoinSettings& join : continuous_methods) {
      successor.reinitialise(at, random_entry(random, to), join);
      const double peak = std::max(1.0, largest(at.acceleration));
      EXPECT_LE(largest(successor.sample().acceleration - at.acceleration), 1e-9 * peak)
          << test::word(join) << ", seed 11, case " << i;
    }
  }
}

TEST_P(JoinOfKinds, ContinuesJerkWithDmp2j) {
  const auto [from, to] = GetParam();
  std::mt19937_64 random(12);
  for (int i = 0; i < cases; ++i) {
    const Sample at = left_by_a_predecessor(random, from);
    Execution successor(test::random_primitive(random, 3, 10, to));
    successor.reinitialise(at, random_entry(random, to), Join::dmp2j);
    EXPECT_LE(largest(successor.state().jerk - at.jerk), 1e-9 * std::max(1.0, largest(at.jerk)))
        << "seed 12, case " << i;
  }
}

TEST_P(JoinOfKinds, IsForgottenInTheEnd) {
  const auto [from, to] = GetParam();
  std::mt19937_64 random(13);
  for (int i = 0; i < 20; ++i) {
    const Sample at = left_by_a_predecessor(random, from);
    Execution plain(test::random_primitive(random, 3, 10, to));
    const double entry = random_entry(random, to);
    plain.reinitialise(at, entry, Join::dmp2);
    std::vector<Execution> joined(continuous_methods.size(), plain);
    for (std::size_t m = 0; m < joined.size(); ++m)
      joined[m].reinitialise(at, entry, continuous_methods[m]);
    const double once =
        (to == Kind::rhythmic ? 4.0 * M_PI : 8.0) * plain.tau();  // two cycles, x = 1e-7
    for (double t = 0.0; t < once; t += dt) {
      plain.step(dt);
      for (Execution& execution : joined) execution.step(dt);
    }
    for (std::size_t m = 0; m < joined.size(); ++m)
      EXPECT_LT(largest(joined[m].sample().position - plain.sample().position),
                to == Kind::rhythmic ? 1e-9 : 1e-5)
          << test::word(continuous_methods[m]) << ", seed 13, case " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(, JoinOfKinds,
                         testing::Combine(testing::Values(Kind::discrete, Kind::rhythmic),
                                          testing::Values(Kind::discrete, Kind::rhythmic)),
                         [](const auto& pair) {
                           return test::word(std::get<0>(pair.param)) + "To" +
                                  test::word(std::get<1>(pair.param));
                         });

TEST(Join, HasNamesThatAreReadBack) {
  for (const Join method : all_joins) EXPECT_EQ(join_from_name(to_string(method)), method);
  EXPECT_EQ(test::refusal([] { join_from_name("dmp4"); }),
            "method \"dmp4\": not known, must be one of dmp2, dmp2a, dmp3, dmp2j");
}

// After half a cycle the learned weights are back; what remains is the transient of the spring, exp(−√K·t/τ).
TEST(RhythmicUndo, LeavesNothingFromTheSecondCycleOn) {
  for (const JoinSettings& join : continuous_methods) {
    Execution joined(rhythm());
    Execution learned(rhythm());
    Sample at = learned.sample();
    at.velocity(0) += 0.5;
    learned.reinitialise(at, 0.3, Join::dmp2);
    joined.reinitialise(at, 0.3, join);
    for (int i = 0; i < 1000; ++i) joined.step(dt), learned.step(dt);
    double worst = 0.0;
    for (int i = 0; i < 1000; ++i) {
      joined.step(dt), learned.step(dt);
      worst = std::max(worst, std::abs(joined.sample().position(0) - learned.sample().position(0)));
    }
    EXPECT_LT(worst, 1e-9) << test::word(join);
  }
}

// The largest change of acceleration from tick to tick falls with the tick: there is no step, neither at the join nor where
// the undo begins and ends.
TEST(RhythmicUndo, NeverStepsInAcceleration) {
  const auto largest_change = [](double tick) {
    Execution joined(rhythm());
    Sample at = joined.sample();
    at.velocity(0) += 0.5;
    at.acceleration(0) = -3.0;
    joined.reinitialise(at, 0.3, Join::dmp2a);
    double worst = 0.0;
    double before = at.acceleration(0);
    for (double t = 0.0; t < 0.6; t += tick) {
      joined.step(tick);
      worst = std::max(worst, std::abs(joined.sample().acceleration(0) - before));
      before = joined.sample().acceleration(0);
    }
    return worst;
  };
  EXPECT_NEAR(largest_change(1e-4) / largest_change(1e-5), 10.0, 0.5);
}

// Few or narrow kernels cannot meet dmp2j's two conditions with weights of a sensible size; it does without them then.
TEST(Join, StaysBoundedWithFewAndNarrowKernels) {
  std::mt19937_64 random(20);
  const auto farthest = [](const Primitive& primitive, const JoinSettings& join, double phase) {
    Execution execution(primitive);
    Sample at = Sample::at_rest(primitive.goal);
    at.velocity(0) = 1.0;
    execution.reinitialise(at, phase, join);
    EXPECT_LT(std::abs(execution.state().jerk(0)), 1e-6) << phase;
    double worst = 0.0;
    for (int k = 0; k < 1000; ++k) {
      execution.step(dt);
      worst = std::max(worst, std::abs(execution.sample().position(0) - primitive.goal(0)));
    }
    return worst;
  };
  for (const int kernels : {2, 3, 4, 8, 20})
    for (int k = 0; k < 40; ++k) {
      Primitive primitive = test::random_primitive(random, 1, kernels, Kind::rhythmic);
      primitive.weights *= 0.1;
      EXPECT_LT(farthest(primitive, Join::dmp2j, 2.0 * M_PI * k / 40.0), 1.0)
          << kernels << " kernels, seed 20";
    }
  for (const double width : {0.3, 0.4, 0.5, 0.75, 1.0}) {
    Primitive primitive = test::random_primitive(random, 1);
    primitive.weights *= 0.1;
    primitive.kernels = Kernels::even_in_time(10, width, primitive.alpha);
    EXPECT_LT(farthest(primitive, Join::dmp2j, 1.0), 1.0) << width << ", seed 20";
  }
}

TEST(LeastCorrection, IsNoLargerThanAnywhereOnAFineGrid) {
  std::mt19937_64 random(18);
  for (int i = 0; i < 20; ++i) {
    Execution execution(test::random_primitive(random, 2, 20, Kind::rhythmic));
    Sample at = execution.sample();
    at.velocity.setRandom();
    const double phase = execution.least_correction_phase(at);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 5000; ++k)
      least = std::min(least, execution.correction(at, 2.0 * M_PI * k / 5000.0));
    EXPECT_LE(execution.correction(at, phase), least * (1.0 + 1e-6)) << "seed 18, case " << i;
    execution.reinitialise(at, phase, Join::dmp2);
    const double step = (execution.sample().acceleration - at.acceleration).squaredNorm();
    EXPECT_NEAR(execution.correction(at, phase), step, 1e-9 * (1.0 + step));
  }
}

}  // namespace
}  // namespace seam
