#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/basis.hpp>
#include <seam/execution.hpp>
#include <seam/learn.hpp>

namespace seam {
namespace {

using test::refusal;

double worst_reproduction_error(const Demonstration& demo, const Primitive& primitive) {
  Execution execution(primitive);
  double worst = 0.0;
  for (int i = 0; i < demo.samples(); ++i) {
    worst = std::max(
        worst,
        (execution.sample().position.transpose() - demo.position.row(i)).cwiseAbs().maxCoeff());
    if (i + 1 < demo.samples()) execution.step(demo.time(i + 1) - demo.time(i));
  }
  return worst;
}

TEST(Learn, GivesBackTheWeightsThatMadeTheDemonstration) {
  std::mt19937_64 random(3);
  Primitive truth = test::random_primitive(random, 3);
  truth.gains = Gains();
  truth.kernels = Kernels::even_in_time(10, 0.75, truth.alpha);
  const int N = 400;
  Demonstration demo{truth.coordinates, Eigen::VectorXd(N), Eigen::MatrixXd(N, 3),
                     Eigen::MatrixXd(N, 3), Eigen::MatrixXd(N, 3)};
  Execution execution(truth);
  for (int i = 0; i < N; ++i) {
    demo.time(i) = truth.tau * i / (N - 1);
    demo.position.row(i) = execution.sample().position;
    demo.velocity.row(i) = execution.sample().velocity;
    demo.acceleration.row(i) = execution.sample().acceleration;
    execution.step(truth.tau / (N - 1));
  }
  // The goal that learning takes is the last sample; the forcing that makes up for the shift is
  // learned with it.
  const Primitive learned = learn(demo);
  EXPECT_LT(worst_reproduction_error(demo, learned), 2e-3);
  demo.position.bottomRows<1>() = truth.goal.transpose();
  demo.velocity.bottomRows<1>() = demo.velocity.row(N - 2);
  Demonstration ends_at_goal = demo;
  const Eigen::RowVectorXd goal = truth.goal.transpose();
  ends_at_goal.acceleration.bottomRows<1>() =
      (truth.gains.K * (goal - goal) - truth.tau * truth.gains.D * demo.velocity.bottomRows<1>()) /
      (truth.tau * truth.tau);
  Eigen::ArrayXd row(10);
  Basis(truth.kernels, truth.alpha).regressor(std::exp(-truth.alpha), row);
  ends_at_goal.acceleration.bottomRows<1>() +=
      row.matrix().transpose() * truth.weights / (truth.tau * truth.tau);
  const Primitive exact = learn(ends_at_goal);
  EXPECT_LT((exact.weights - truth.weights).cwiseAbs().maxCoeff(),
            1e-7 * truth.weights.cwiseAbs().maxCoeff());
}

TEST(Learn, ReproducesAMinimumJerkMovement) {
  const Demonstration demo = test::minimum_jerk();
  const Primitive primitive = learn(demo);
  EXPECT_DOUBLE_EQ(primitive.tau, 1.0);
  EXPECT_DOUBLE_EQ(primitive.goal(0), 1.0);
  EXPECT_LT(worst_reproduction_error(demo, primitive), 3e-3);
}

TEST(Learn, MoreKernelsFitBetter) {
  const Demonstration demo = test::minimum_jerk();
  LearnSettings settings;
  double before = 1.0;
  for (const int kernels : {5, 10, 20, 40}) {
    settings.kernels = kernels;
    const double error = worst_reproduction_error(demo, learn(demo, settings));
    EXPECT_LT(error, 0.5 * before) << kernels;
    before = error;
  }
}

TEST(Learn, KeepsTheStateAtTheStartOfAMovingDemonstration) {
  const auto line = [](double t) { return Eigen::Vector3d(0.5 + 0.4 * t, 0.4, 0.0); };
  const Primitive primitive = learn(test::demonstrate(1.0, line));
  EXPECT_DOUBLE_EQ(primitive.start_velocity(0), 0.4);
  EXPECT_DOUBLE_EQ(primitive.start_position(0), 0.5);
  EXPECT_LT(worst_reproduction_error(test::demonstrate(1.0, line), primitive), 1e-3);
}

TEST(Learn, RefusesTooFewSamplesAndSizesThatDoNotMatch) {
  Demonstration demo =
      test::demonstrate(0.018, [](double t) { return Eigen::Vector3d(t, 1.0, 0.0); });
  EXPECT_EQ(refusal([&] { learn(demo); }),
            "demonstration: 19 samples, must be >= 20 (2 per kernel)");
  demo.velocity.resize(3, 1);
  EXPECT_EQ(refusal([&] { learn(demo); }),
            "demonstration: time, position, velocity and acceleration differ in size");
}

}  // namespace
}  // namespace seam
