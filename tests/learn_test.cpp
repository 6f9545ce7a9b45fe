#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include "tests/wiggle.hpp"
#include <seam/basis.hpp>
#include <seam/execution.hpp>
#include <seam/learn.hpp>

namespace seam {
namespace {

using test::refusal;
using test::wiggle;

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
  Basis(truth).regressor(std::exp(-truth.alpha), row.data());
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

Demonstration circle(int samples, double cycles) {
  Demonstration demo{{"x", "y"},
                     Eigen::VectorXd(samples),
                     Eigen::MatrixXd(samples, 2),
                     Eigen::MatrixXd(samples, 2),
                     Eigen::MatrixXd(samples, 2)};
  const double w = 2.0 * M_PI / 1.2;
  for (int i = 0; i < samples; ++i) {
    const double t = cycles * 1.2 * i / (samples - 1);
    demo.time(i) = 3.0 + t;
    demo.position.row(i) << 0.5 + 0.1 * std::cos(w * t), 0.05 * std::sin(2.0 * w * t);
    demo.velocity.row(i) << -0.1 * w * std::sin(w * t), 0.1 * w * std::cos(2.0 * w * t);
    demo.acceleration.row(i) << -0.1 * w * w * std::cos(w * t),
        -0.2 * w * w * std::sin(2.0 * w * t);
  }
  return demo;
}

struct KernelFigures {
  double width, condition, forcing_error, end_error;
};

TEST(Learn, KernelWidthsTradeConditionForFit) {
  const Demonstration demo = wiggle();
  for (const auto& want :
       {KernelFigures{0.5, 11.0, 5.0e-2, 0.002}, KernelFigures{0.75, 22.0, 1.5e-2, 0.003},
        KernelFigures{1.0, 49.0, 9.7e-3, 0.008}}) {
    LearnSettings settings;
    settings.width = want.width;
    const Primitive primitive = learn(demo, settings);
    const LearnReport report = assess(demo, primitive);
    EXPECT_NEAR(report.condition, want.condition, 0.5) << want.width;
    EXPECT_NEAR(report.forcing_error, want.forcing_error, 0.04 * want.forcing_error) << want.width;
    Execution execution(primitive);
    for (int i = 0; i < 2000; ++i) execution.step(1e-3);
    EXPECT_NEAR(std::abs(execution.sample().position(0) - 1.0), want.end_error, 1e-3) << want.width;
  }
}

TEST(Learn, ReadsTheKernelWidthAsAMultipleBecauseAnAbsoluteOneIsHopeless) {
  LearnSettings settings;
  settings.width = 0.5 / 0.0218;  // σ = 0.5 where the centres lie closest
  EXPECT_GT(assess(wiggle(), learn(wiggle(), settings)).condition, 1e12);
}

TEST(Learn, RhythmicKernelsOfTwentyAreWellConditioned) {
  const Demonstration demo = circle(1001, 1.0);
  LearnSettings settings;
  settings.kind = Kind::rhythmic;
  settings.period = 1.2;
  EXPECT_NEAR(assess(demo, learn(demo, settings)).condition, 4.9e3, 0.05e3);
  settings.width = 0.2 * 20.0 / (2.0 * M_PI);
  EXPECT_NEAR(assess(demo, learn(demo, settings)).condition, 37.0, 0.5);
}

TEST(Learn, LocallyWeightedIsSixteenTimesWorse) {
  const Demonstration demo = wiggle();
  LearnSettings settings;
  const double global = assess(demo, learn(demo, settings)).forcing_error;
  settings.method = LearnMethod::locally_weighted;
  EXPECT_NEAR(assess(demo, learn(demo, settings)).forcing_error / global, 16.0, 1.0);
}

TEST(Learn, LocallyWeightedFindsAConstantForcing) {
  // τ²ÿ + τDẏ + K(y − g) = x·c has every wⱼ = c, whatever the kernels' overlap.
  const double a = 2.0;
  const Gains gains;
  Demonstration demo = test::demonstrate(1.0, [&](double t) {
    const double x = std::exp(-a * t);
    return Eigen::Vector3d(x, -a * x, a * a * x);
  });
  const double goal = std::exp(-a);
  demo.acceleration.array() += gains.K * goal;
  LearnSettings settings;
  settings.method = LearnMethod::locally_weighted;
  const double c = a * a - a * gains.D + gains.K;
  EXPECT_LT((learn(demo, settings).weights.array() - c).abs().maxCoeff(), 1e-9 * c);
}

TEST(Learn, ARhythmHasItsPeriodAndCentreFromTheData) {
  const Demonstration demo = circle(800, 4.3);
  LearnSettings settings;
  settings.kind = Kind::rhythmic;
  const Primitive primitive = learn(demo, settings);
  EXPECT_EQ(primitive.kind, Kind::rhythmic);
  EXPECT_EQ(primitive.kernels.count(), 20);
  EXPECT_NEAR(primitive.kernels.widths(0), 0.32, 1e-12);
  EXPECT_NEAR(primitive.tau, 1.2 / (2.0 * M_PI), 1e-8);
  EXPECT_LT((primitive.goal - Eigen::Vector2d(0.5, 0.0)).norm(), 1e-8);
  EXPECT_DOUBLE_EQ(primitive.start_position(0), 0.6);
  EXPECT_LT(worst_reproduction_error(demo, primitive), 1e-5);
}

TEST(Learn, ARhythmGivesBackTheWeightsThatMadeIt) {
  std::mt19937_64 random(4);
  Primitive truth = test::random_primitive(random, 2, 20, Kind::rhythmic);
  truth.gains = Gains();
  truth.kernels = Kernels::even_in_phase(20, 0.7);
  const double period = 2.0 * M_PI * truth.tau;
  // Once round to be rid of the start; the centre that learning finds is the mean, and shifts weights.
  Execution execution(truth);
  for (int i = 0; i < 5000; ++i) execution.step(period / 1000.0);
  Demonstration demo{truth.coordinates, Eigen::VectorXd(1000), Eigen::MatrixXd(1000, 2),
                     Eigen::MatrixXd(1000, 2), Eigen::MatrixXd(1000, 2)};
  for (int i = 0; i < 1000; ++i) {
    demo.time(i) = period * i / 1000.0;
    demo.position.row(i) = execution.sample().position;
    demo.velocity.row(i) = execution.sample().velocity;
    demo.acceleration.row(i) = execution.sample().acceleration;
    execution.step(period / 1000.0);
  }
  LearnSettings settings;
  settings.kind = Kind::rhythmic;
  settings.period = period;
  settings.width = 0.7;
  const Primitive learned = learn(demo, settings);
  const Eigen::MatrixXd shifted =
      truth.weights.rowwise() + truth.gains.K * (truth.goal - learned.goal).transpose();
  EXPECT_LT((learned.weights - shifted).norm(), 1e-5 * shifted.norm());
}

TEST(Learn, TakesTheFewestKernelsThatReachAPrecision) {
  const Demonstration demo = wiggle(501);
  LearnSettings settings;
  settings.precision = 1e-3;
  const Primitive primitive = learn(demo, settings);
  EXPECT_LE(assess(demo, primitive).error_max, 1e-3);
  LearnSettings fewer;
  fewer.kernels = primitive.kernels.count() - 1;
  for (const double width : {0.5, 0.75, 1.0, 1.5}) {
    fewer.width = width;
    EXPECT_GT(assess(demo, learn(demo, fewer)).error_max, 1e-3) << width;
  }
  settings.precision = 1e-5;
  EXPECT_GT(learn(demo, settings).kernels.count(), primitive.kernels.count());
  settings.kernels = 8;
  EXPECT_THAT(refusal([&] { learn(demo, settings); }),
              testing::MatchesRegex("demonstration: precision 1e-05 is not reached: [0-9.e-]+ at "
                                    "best, with 8 of at most 8 kernels"));
}

TEST(Learn, ReportsTheErrorOfTheRollOut) {
  const Demonstration demo = wiggle(301);
  const Primitive primitive = learn(demo);
  const LearnReport report = assess(demo, primitive);
  EXPECT_NEAR(report.error_max, worst_reproduction_error(demo, primitive), 1e-3 * report.error_max);
  EXPECT_GT(report.error_max, report.error_rms);
  Primitive other = primitive;
  other.coordinates = {"z"};
  EXPECT_EQ(refusal([&] { assess(demo, other); }),
            "demonstration: coordinates differ from the primitive's, must be the same");
}

TEST(Learn, IsNotDisturbedByKernelsThatSawNothing) {
  LearnSettings settings;
  settings.kernels = 20;
  settings.width = 0.05;
  Demonstration demo = wiggle(41);
  EXPECT_TRUE(learn(demo, settings).weights.allFinite());
  settings.method = LearnMethod::locally_weighted;
  EXPECT_TRUE(learn(demo, settings).weights.allFinite());
}

TEST(Learn, RefusesSettingsOutOfRange) {
  const Demonstration demo = wiggle(101);
  const auto message = [&](const LearnSettings& settings) {
    return refusal([&] { learn(demo, settings); });
  };
  LearnSettings settings;
  settings.kernels = 1;
  EXPECT_EQ(message(settings), "learning: kernels 1, must be >= 2, or 0 for the default");
  settings = {};
  settings.width = -1.0;
  EXPECT_EQ(message(settings), "learning: width -1, must be > 0, or 0 for the default");
  settings = {};
  settings.precision = std::nan("");
  EXPECT_EQ(message(settings), "learning: precision nan, must be > 0, or 0 for none");
  settings = {};
  settings.gains.K = -1.0;
  EXPECT_EQ(message(settings), "primitive: K -1, must be in 1e-06 to 1e+06");
  settings = {};
  settings.kind = Kind::rhythmic;
  settings.period = -0.5;
  EXPECT_EQ(message(settings), "learning: period -0.5, must be > 0 s, or 0 to find it");
  settings.period = 1.5;
  EXPECT_EQ(message(settings), "demonstration: lasts 1 s, must hold a period of 1.5 s");
  settings.period = 0.0;
  EXPECT_THAT(message(settings), testing::HasSubstr("no period found"));
}

TEST(Learn, RefusesTooFewSamplesAndSizesThatDoNotMatch) {
  Demonstration demo =
      test::demonstrate(0.018, [](double t) { return Eigen::Vector3d(t, 1.0, 0.0); });
  EXPECT_EQ(refusal([&] { learn(demo); }),
            "demonstration: 19 samples, must be >= 20 (2 per kernel)");
  demo.velocity.resize(3, 1);
  EXPECT_EQ(refusal([&] { learn(demo); }),
            "demonstration: time, position, velocity and acceleration differ in size");
  demo = wiggle(101);
  demo.velocity(7, 0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal([&] { learn(demo); }),
            "demonstration: a velocity or acceleration is not finite");
}

}  // namespace
}  // namespace seam
