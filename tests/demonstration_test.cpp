#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/demonstration.hpp>

namespace seam {
namespace {

using test::refusal;

TEST(Demonstration, DerivativesOfACubicAreExactAtUnevenTimes) {
  const auto cubic = [](double t) { return 0.3 - t + 2.0 * t * t - 1.5 * t * t * t; };
  Eigen::VectorXd time(40);
  for (int i = 0; i < 40; ++i) time(i) = 1.0 + 0.02 * i + 0.008 * std::sin(7.0 * i);
  const auto demo = Demonstration::from_positions({"y"}, time, time.unaryExpr(cubic));
  for (int i = 0; i < 40; ++i) {
    const double t = time(i);
    EXPECT_NEAR(demo.velocity(i, 0), -1.0 + 4.0 * t - 4.5 * t * t, 1e-10) << i;
    EXPECT_NEAR(demo.acceleration(i, 0), 4.0 - 9.0 * t, 1e-8) << i;
  }
}

TEST(Demonstration, AWiderWindowSmoothsMore) {
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(201, 0.0, 2.0);
  const auto tremor = [](double t) { return t + 1e-3 * std::sin(2.0 * M_PI * 25.0 * t); };
  const auto error = [&](double window) {
    const auto demo = Demonstration::from_positions({"y"}, time, time.unaryExpr(tremor), {window});
    return (demo.velocity.array() - 1.0).abs().maxCoeff();
  };
  EXPECT_LT(error(0.1), 0.3 * error(0.0));
}

TEST(Demonstration, ReadsACsvFile) {
  const auto demo = Demonstration::read(std::string(SEAM_ASSETS) + "/demos/ramp_up.csv");
  EXPECT_EQ(demo.coordinates, std::vector<std::string>{"E1"});
  EXPECT_EQ(demo.samples(), 101);
  EXPECT_DOUBLE_EQ(demo.duration(), 1.0);
  EXPECT_LT((demo.velocity.array() - 0.6).abs().maxCoeff(), 1e-9);
}

TEST(Demonstration, RefusesBadFiles) {
  const TempFolder folder;
  const auto message = [&](const std::string& content) {
    const std::string path = folder.write("d.csv", content);
    return refusal([&] { Demonstration::read(path); }).substr(path.size());
  };
  EXPECT_EQ(message("t,a\n0,0\n"), ":1: first column \"t\", must be \"time\" [s]");
  EXPECT_EQ(message("time,a\n0,0\n1,0\n1,0\n"), ":4: column \"time\": does not increase");
  EXPECT_EQ(message("time,a\n0,0\n1,0\n0.5,0\n"), ":4: column \"time\": does not increase");
  EXPECT_EQ(message("time,a\n0,0\n1,0\n"), ": demonstration: 2 samples, must be >= 5");
  EXPECT_EQ(message("time\n0\n1\n2\n3\n4\n"), ": demonstration: no coordinates");
}

}  // namespace
}  // namespace seam
