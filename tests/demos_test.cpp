#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/learn.hpp>

namespace seam {
namespace {

const std::string folder = std::string(SEAM_ASSETS) + "/demos/";
const std::vector<std::string> motions{"reach",       "pour",          "wipe",      "carry_lift",
                                       "carry_place", "wipe_approach", "wipe_away", "catch",
                                       "follow",      "aim",           "thread"};

LearnSettings settings_of(const std::string& motion) {
  LearnSettings settings;
  if (motion == "wipe") settings.kind = Kind::rhythmic;
  return settings;
}

TEST(Demos, AreWhatTheirScriptGenerates) {
  const TempFolder fresh;
  ASSERT_EQ(std::system(("sh " + folder + "generate.sh " + fresh.path("")).c_str()), 0);
  auto files = motions;
  files.insert(files.end(), {"minimum_jerk", "minimum_jerk_on"});
  for (const std::string& motion : files) {
    const std::string shipped = test::read_file(folder + motion + ".csv");
    EXPECT_FALSE(shipped.empty()) << motion;
    EXPECT_TRUE(test::read_file(fresh.path(motion + ".csv")) == shipped) << motion;
  }
}

TEST(Demos, AreWithinTheArmsReachAndAHandsSpeed) {
  for (const std::string& motion : motions) {
    const auto demo = Demonstration::read(folder + motion + ".csv");
    const Eigen::ArrayXd radius = demo.position.leftCols(2).rowwise().norm();
    EXPECT_GT(radius.minCoeff(), 0.35) << motion;
    EXPECT_LT(radius.maxCoeff(), 0.85) << motion;
    EXPECT_GT(demo.position.col(2).minCoeff(), 0.0) << motion;
    EXPECT_LT(demo.position.col(2).maxCoeff(), 0.8) << motion;
    const double speed = demo.velocity.leftCols(3).rowwise().norm().maxCoeff();
    EXPECT_GT(speed, 0.05) << motion;
    EXPECT_LT(speed, 1.2) << motion;
    if (demo.dimensions() == 7) {
      EXPECT_LT((demo.position.rightCols(4).rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-5);
    }
  }
}

TEST(Demos, AreLearnedToAMillimetreOrTwo) {
  for (const std::string& motion : motions) {
    const auto demo = Demonstration::read(folder + motion + ".csv");
    const LearnReport report = assess(demo, learn(demo, settings_of(motion)));
    EXPECT_LT(report.error_max, 2e-3) << motion;
    EXPECT_LT(report.error_rms, 3e-4) << motion;
  }
}

TEST(Demos, WipingIsSixCyclesOfItsPeriod) {
  const auto demo = Demonstration::read(folder + "wipe.csv");
  const Primitive wipe = learn(demo, settings_of("wipe"));
  EXPECT_NEAR(2.0 * M_PI * wipe.tau, 1.2, 1e-3);
  EXPECT_NEAR(demo.duration(), 6.0 * 1.2, 1e-9);
  EXPECT_LT((wipe.goal - Eigen::Vector3d(0.55, 0.10, 0.02)).norm(), 1e-4);
}

TEST(Demos, CarryingGoesOnWhereLiftingEnds) {
  const auto lift = Demonstration::read(folder + "carry_lift.csv");
  const auto place = Demonstration::read(folder + "carry_place.csv");
  EXPECT_LT((lift.position.bottomRows<1>() - place.position.topRows<1>()).norm(), 1e-3);
  for (const auto* move : {&lift, &place})
    EXPECT_NEAR((move->position.bottomRows<1>() - move->position.topRows<1>()).norm(), 0.3, 0.02);
}

}  // namespace
}  // namespace seam
