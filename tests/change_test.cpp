#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "tests/joins.hpp"
#include "tests/support.hpp"
#include <seam/execution.hpp>

namespace seam {
namespace {

using test::continuous_methods;
using test::largest;
using test::rhythm;

constexpr double dt = 1e-3;

// Changes on the way, at any phase: the state before against the state after.
struct Change {
  const char* name;
  bool (*apply)(Execution&);
};

class ChangeOnTheWay : public testing::TestWithParam<std::tuple<Change, Kind>> {};

TEST_P(ChangeOnTheWay, ContinuesWhatTheMethodContinues) {
  const auto [change, kind] = GetParam();
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    for (const JoinSettings& join : test::all_methods()) {
      Execution execution(test::random_primitive(random, 3, 10, kind));
      const Sample start = Sample::at_rest(execution.sample().position);
      execution.reinitialise(start, execution.basis().start_phase(), join);
      execution.step(3.0 * uniform(random) *
                     execution.tau());  // x down to 0.002: beyond the hold of the weights
      const Sample before = execution.state();
      if (!change.apply(execution)) continue;
      const Sample after = execution.state();
      EXPECT_LT(largest(after.position - before.position), 1e-13);
      EXPECT_LT(largest(after.velocity - before.velocity), 1e-13);
      if (join.method != Join::dmp2) {
        EXPECT_LE(largest(after.acceleration - before.acceleration),
                  1e-9 * std::max(1.0, largest(before.acceleration)))
            << test::word(join) << ", seed 15, case " << i;
      }
      if (join.method == Join::dmp2j) {
        EXPECT_LE(largest(after.jerk - before.jerk), 1e-9 * std::max(1.0, largest(before.jerk)))
            << "seed 15, case " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ChangeOnTheWay,
    testing::Combine(
        testing::Values(Change{"Goal",
                               [](Execution& e) { return e.set_goal(e.goal().array() + 0.3); }},
                        Change{"Slower", [](Execution& e) { return e.set_tau(1.8 * e.tau()); }},
                        Change{"Faster", [](Execution& e) { return e.set_tau(0.6 * e.tau()); }},
                        Change{"Amplitude",
                               [](Execution& e) {
                                 return e.set_amplitude(1.4) || e.kind() == Kind::discrete;
                               }}),
        testing::Values(Kind::discrete, Kind::rhythmic)),
    [](const auto& change) {
      return std::get<0>(change.param).name + test::word(std::get<1>(change.param));
    });

TEST(Change, LeadsToTheNewGoalHoweverLateItComes) {
  std::mt19937_64 random(16);
  for (const Join method : all_joins)
    for (const double at : {0.1, 0.9, 2.5}) {
      Execution execution(test::random_primitive(random, 2));
      execution.reinitialise(Sample::at_rest(execution.sample().position), 1.0, method);
      execution.step(at * execution.tau());
      const Eigen::Vector2d goal = execution.goal() + Eigen::Vector2d(0.4, -0.3);
      ASSERT_TRUE(execution.set_goal(goal));
      for (int i = 0; i < 10; ++i) execution.step(execution.tau());
      EXPECT_LT(largest(execution.sample().position - goal), 1e-4)
          << to_string(method) << " at " << at;
    }
}

// A goal that moves a little at every tick is followed, early or late, discrete or rhythmic, and where it stops the motion
// is that of the plain second-order system.
TEST(Change, FollowsAGoalThatStreams) {
  std::mt19937_64 random(19);
  for (const Kind kind : {Kind::discrete, Kind::rhythmic})
    for (const Join method : all_joins)
      for (const double begin : {0.2, 1.8}) {
        const Primitive primitive = test::random_primitive(random, 1, 20, kind);
        Execution streamed(primitive);
        Execution plain(primitive);
        const Sample start = Sample::at_rest(primitive.start_position);
        streamed.reinitialise(start, streamed.basis().start_phase(), method);
        plain.reinitialise(start, plain.basis().start_phase(), Join::dmp2);
        const Eigen::VectorXd goal = primitive.goal.array() + 0.3;
        plain.set_goal(goal);
        for (int k = 0; k < 12000; ++k) {
          const double moved = std::clamp(k * dt - begin, 0.0, 1.0);
          ASSERT_TRUE(streamed.set_goal(primitive.goal.array() + 0.3 * moved));
          streamed.step(dt);
          plain.step(dt);
        }
        EXPECT_LT(largest(streamed.sample().position - plain.sample().position), 1e-3)
            << to_string(method) << (kind == Kind::discrete ? " discrete " : " rhythmic ") << begin
            << ", seed 19";
      }
}

TEST(Change, OfTheAmplitudeToNothingAndBackStaysFinite) {
  for (const JoinSettings& join : continuous_methods) {
    Execution execution(rhythm());
    execution.reinitialise(Sample::at_rest(execution.sample().position), 0.0, join);
    for (const double amplitude : {0.0, 1e-200, -1.0, 1.0}) {
      ASSERT_TRUE(execution.set_amplitude(amplitude));
      for (int k = 0; k < 300; ++k) execution.step(dt);
      EXPECT_LT(std::abs(execution.sample().position(0)), 10.0)
          << test::word(join) << " " << amplitude;
    }
  }
}

TEST(Change, RefusesWhatWillNotDoAndChangesNothing) {
  std::mt19937_64 random(17);
  Execution execution(test::random_primitive(random, 2));
  execution.step(0.1);
  const Sample before = execution.sample();
  EXPECT_FALSE(execution.set_tau(0.0));
  EXPECT_FALSE(execution.set_tau(NAN));
  EXPECT_FALSE(execution.set_goal(Eigen::Vector2d(0.0, NAN)));
  EXPECT_FALSE(execution.set_goal(Eigen::Vector3d::Zero()));
  EXPECT_FALSE(execution.set_amplitude(2.0));
  EXPECT_EQ(execution.sample().acceleration, before.acceleration);
}

TEST(RhythmicAmplitude, ScalesTheMotionAboutItsCentre) {
  Execution one(rhythm());
  Execution two(rhythm());
  two.set_amplitude(2.0);
  for (int i = 0; i < 3000; ++i) one.step(dt), two.step(dt);
  for (int i = 0; i < 1000; ++i) {
    one.step(dt), two.step(dt);
    EXPECT_NEAR(two.sample().position(0) - two.goal()(0),
                2.0 * (one.sample().position(0) - one.goal()(0)), 1e-9);
  }
}

}  // namespace
}  // namespace seam
