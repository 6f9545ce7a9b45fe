#include <limits>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/recursive_learner.hpp>

namespace seam {
namespace {

using test::refusal;

Demonstration circle(double period, double duration) {
  const double w = 2.0 * M_PI / period;
  return test::demonstrate(duration, [=](double t) {
    const double a = w * t;
    return Eigen::Vector3d(0.3 + std::cos(a) + 0.2 * std::sin(2.0 * a),
                           w * (-std::sin(a) + 0.4 * std::cos(2.0 * a)),
                           w * w * (-std::cos(a) - 0.8 * std::sin(2.0 * a)));
  });
}

void feed(RecursiveLearner& learner, const Demonstration& demo, int samples) {
  for (int i = learner.samples(); i < samples; ++i)
    ASSERT_TRUE(learner.add(demo.time(i), demo.position.row(i).transpose(),
                            demo.velocity.row(i).transpose(),
                            demo.acceleration.row(i).transpose()));
}

double difference(const Primitive& a, const Primitive& b) {
  return (a.weights - b.weights).norm() / b.weights.norm();
}

TEST(RecursiveLearner, AgreesWithTheBatchSolution) {
  for (const double width : {0.5, 0.75, 1.0}) {
    LearnSettings settings;
    settings.width = width;
    const Demonstration demo = test::minimum_jerk();
    RecursiveLearner learner(demo.coordinates, Eigen::VectorXd::Ones(1), 1.0, settings);
    feed(learner, demo, demo.samples());
    EXPECT_LT(difference(learner.primitive(), learn(demo, settings)), 1e-6) << width;
    settings.method = LearnMethod::recursive;
    EXPECT_EQ(learner.primitive().weights, learn(demo, settings).weights);
  }
}

TEST(RecursiveLearner, AgreesWithTheBatchSolutionOfARhythm) {
  LearnSettings settings;
  settings.kind = Kind::rhythmic;
  settings.width = 0.2 * 20.0 / (2.0 * M_PI);
  settings.period = 0.8;
  const Demonstration demo = circle(0.8, 2.0);
  const Primitive batch = learn(demo, settings);
  RecursiveLearner learner(demo.coordinates, batch.goal, settings.period, settings);
  feed(learner, demo, demo.samples());
  EXPECT_LT(difference(learner.primitive(), batch), 1e-6);
  EXPECT_EQ(learner.primitive().start_velocity, batch.start_velocity);
  EXPECT_DOUBLE_EQ(learner.primitive().tau, batch.tau);
}

TEST(RecursiveLearner, KnowsTheRhythmAfterOneCycle) {
  LearnSettings settings;
  settings.kind = Kind::rhythmic;
  settings.period = 0.8;
  const Demonstration demo = circle(0.8, 2.0);
  RecursiveLearner learner(demo.coordinates, Eigen::VectorXd::Constant(1, 0.3), 0.8, settings);
  feed(learner, demo, 400);
  EXPECT_GT(assess(demo, learner.primitive()).error_max, 0.01);
  feed(learner, demo, 801);
  EXPECT_LT(assess(demo, learner.primitive()).error_max, 0.001);
}

TEST(RecursiveLearner, AddsWithoutAllocatingAndLeavesOutWhatIsNotFinite) {
  const Eigen::Vector2d at(1.0, 2.0);
  const Eigen::Vector2d bad(1.0, std::numeric_limits<double>::infinity());
  RecursiveLearner learner({"a", "b"}, at, 1.0);
  {
    const AllocationGuard guard;
    EXPECT_TRUE(learner.add(0.1, at, at, at));
    EXPECT_TRUE(learner.add(0.2, at, at, at));
    EXPECT_EQ(guard.allocations(), 0);
  }
  const Eigen::MatrixXd before = learner.primitive().weights;
  EXPECT_FALSE(learner.add(0.3, at, bad, at));
  EXPECT_FALSE(learner.add(std::nan(""), at, at, at));
  EXPECT_FALSE(learner.add(0.3, at, at, Eigen::Vector3d::Zero()));
  EXPECT_EQ(learner.samples(), 2);
  EXPECT_EQ(learner.primitive().weights, before);
}

TEST(RecursiveLearner, RefusesWhatIsOutOfRange) {
  const Eigen::VectorXd goal = Eigen::VectorXd::Zero(1);
  const auto message = [&](double duration, double lambda) {
    return refusal([&] { RecursiveLearner({"y"}, goal, duration, {}, lambda); });
  };
  EXPECT_EQ(message(1.0, 0.0), "recursive learner: lambda 0.000000, must be > 0");
  EXPECT_EQ(message(-1.0, 1e8), "primitive: tau -1, must be in 1e-06 to 1e+09");
}

}  // namespace
}  // namespace seam
