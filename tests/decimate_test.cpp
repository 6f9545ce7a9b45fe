#include "bench/decimate.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace seam {
namespace {

const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(9001, 0.0, 9.0);

TEST(Decimate, KeepsEveryTickBesideAJoinAndSomeElsewhere) {
  const auto kept = kept_ticks(time, {2.0, 7.0}, 0.02, 900);
  EXPECT_LT(kept.size(), 1000U);
  EXPECT_EQ(kept.front(), 0);
  EXPECT_EQ(kept.back(), 9000);
  for (const Eigen::Index join : {2000, 7000})
    for (Eigen::Index k = join - 20; k <= join + 20; ++k) EXPECT_THAT(kept, testing::Contains(k));
  for (std::size_t i = 1; i < kept.size(); ++i) {
    EXPECT_GT(kept[i], kept[i - 1]);
    EXPECT_LE(kept[i], kept[i - 1] + 10);
  }
}

TEST(Decimate, LeavesASmoothCurveAsItIs) {
  const auto kept = kept_ticks(time, {2.0}, 0.02, 900);
  const Eigen::MatrixXd shown = decimated((2.0 * time.array()).sin().matrix(), kept);
  for (std::size_t i = 0; i < kept.size(); ++i)
    EXPECT_EQ(shown(static_cast<Eigen::Index>(i)), std::sin(2.0 * time(kept[i])));
}

TEST(Decimate, ShowsWhatIsShorterThanItsSpacing) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(9001, 2);
  values(4444, 0) = 5.0;
  values(4446, 0) = -3.0;
  const Eigen::MatrixXd shown = decimated(values, kept_ticks(time, {2.0}, 0.02, 900));
  EXPECT_EQ(shown.col(0).maxCoeff(), 5.0);
  EXPECT_EQ(shown.col(0).minCoeff(), -3.0);
  EXPECT_EQ(shown.col(1).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Decimate, KeepsAShortRecordingWhole) {
  const Eigen::VectorXd few = time.head(50);
  EXPECT_EQ(kept_ticks(few, {}, 0.02, 900).size(), 50U);
  EXPECT_EQ(decimated(few, kept_ticks(few, {}, 0.02, 900)), few);
}

}  // namespace
}  // namespace seam
