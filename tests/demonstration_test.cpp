#include <random>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/demonstration.hpp>

namespace seam {
namespace {

using test::refusal;

Eigen::VectorXd uneven_times(int count, double rate) {
  return Eigen::VectorXd::NullaryExpr(
      count, [=](Eigen::Index i) { return (i + 0.3 * std::sin(1.7 * i)) / rate; });
}

/// What of a sinusoid's velocity is left, away from the ends.
double gain(double frequency, double cutoff, double rate) {
  const auto N = static_cast<int>(30.0 / cutoff * rate);
  const Eigen::VectorXd time = uneven_times(N, rate);
  const double w = 2.0 * M_PI * frequency;
  const auto demo = Demonstration::from_positions(
      {"y"}, time, time.unaryExpr([=](double t) { return std::sin(w * t) / w; }), {cutoff});
  const Eigen::VectorXd middle = (w * time.segment(N / 4, N / 2)).array().cos();
  return middle.dot(demo.velocity.col(0).segment(N / 4, N / 2)) / middle.squaredNorm();
}

TEST(Demonstration, DerivativesOfAQuadraticAreExactAtUnevenTimes) {
  Eigen::VectorXd time = uneven_times(60, 50.0).array() + 1.0;
  const auto quadratic = [](double t) { return 0.3 - t + 2.0 * t * t; };
  for (const double cutoff : {1e-3, 0.1, 1.0, 6.0, 1e9}) {
    const double rounding = cutoff < 0.1 ? 1e-7 : 1e-9;
    const auto demo =
        Demonstration::from_positions({"y"}, time, time.unaryExpr(quadratic), {cutoff});
    EXPECT_LT((demo.velocity.array() + 1.0 - 4.0 * time.array()).abs().maxCoeff(), rounding)
        << cutoff;
    EXPECT_LT((demo.acceleration.array() - 4.0).abs().maxCoeff(), 100.0 * rounding) << cutoff;
  }
}

TEST(Demonstration, TheFitPassesFrequenciesAsItsCutOffSays) {
  for (const double cutoff : {3.0, 6.0})
    for (const double rate : {120.0, 1000.0})
      for (const double ratio : {0.25, 0.5, 0.8, 1.0, 1.25, 1.5, 2.0})
        EXPECT_NEAR(gain(ratio * cutoff, cutoff, rate), 1.0 / (1.0 + std::pow(ratio, 6)), 5e-4)
            << ratio << " x " << cutoff << " Hz at " << rate << " Hz";
  EXPECT_LT(std::abs(gain(60.0, 6.0, 1000.0)), 1e-4);
}

TEST(Demonstration, DerivativesOfAMinimumJerkMovementAreRightToItsEnds) {
  const Demonstration exact = test::minimum_jerk();
  const auto demo = Demonstration::from_positions({"y"}, exact.time, exact.position);
  const Eigen::ArrayXd velocity = (demo.velocity - exact.velocity).cwiseAbs();
  const Eigen::ArrayXd acceleration = (demo.acceleration - exact.acceleration).cwiseAbs();
  EXPECT_LT(velocity.segment(200, 601).maxCoeff(), 1e-3 * 1.875);
  EXPECT_LT(acceleration.segment(200, 601).maxCoeff(), 5e-3 * 5.77);
  EXPECT_LT(velocity.maxCoeff(), 0.01 * 1.875);
  EXPECT_LT(acceleration.maxCoeff(), 0.11 * 5.77);
  EXPECT_EQ(demo.position, exact.position);
}

TEST(Demonstration, TremorAndNoiseHardlyShowInTheVelocity) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 1e-4);
  const Eigen::VectorXd time = uneven_times(241, 120.0);
  const auto demo = Demonstration::from_positions({"y"}, time, time.unaryExpr([&](double t) {
    return 0.4 * t + 3e-4 * std::sin(2.0 * M_PI * 10.0 * t) + noise(random);
  }));
  EXPECT_LT((demo.velocity.array() - 0.4).abs().maxCoeff(), 0.04);
  EXPECT_LT((demo.velocity.col(0).segment(40, 160).array() - 0.4).abs().maxCoeff(), 0.004);
}

TEST(Demonstration, ReadsACsvFile) {
  const auto demo = Demonstration::read(std::string(SEAM_ASSETS) + "/demos/ramp_up.csv");
  EXPECT_EQ(demo.coordinates, std::vector<std::string>{"E1"});
  EXPECT_EQ(demo.samples(), 101);
  EXPECT_DOUBLE_EQ(demo.duration(), 1.0);
  EXPECT_LT((demo.velocity.array() - 0.6).abs().maxCoeff(), 1e-9);
}

TEST(Demonstration, TakesDerivativesFromTheFileWhereItHasThem) {
  const TempFolder folder;
  std::string both = "time,vel.a,a,b,acc.b,acc.a,vel.b\n";
  std::string velocity = "time,a,b,vel.b,vel.a\n";
  for (int i = 0; i < 50; ++i) {
    const std::string t = std::to_string(0.02 * i);
    both += t + ",1,2,3,4,5,6\n";
    velocity += t + ",7,8," + t + ",0\n";
  }
  const auto given = Demonstration::read(folder.write("both.csv", both));
  EXPECT_EQ(given.coordinates, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(given.position.row(9), Eigen::RowVector2d(2, 3));
  EXPECT_EQ(given.velocity.row(9), Eigen::RowVector2d(1, 6));
  EXPECT_EQ(given.acceleration.row(9), Eigen::RowVector2d(5, 4));
  const auto half = Demonstration::read(folder.write("velocity.csv", velocity));
  EXPECT_DOUBLE_EQ(half.velocity(49, 1), 0.98);
  EXPECT_LT((half.acceleration.col(1).array() - 1.0).abs().maxCoeff(), 1e-8);
}

TEST(Demonstration, ResamplesToEvenTimes) {
  const Eigen::VectorXd time = uneven_times(200, 100.0);
  const auto curve = [](double t, int order) {
    return std::pow(5.0, order) * std::sin(5.0 * t + order * 0.5 * M_PI);
  };
  const auto values = [&](const Eigen::VectorXd& at, int order) {
    return Eigen::MatrixXd(at.unaryExpr([&](double t) { return curve(t, order); }));
  };
  const Demonstration demo{{"y"}, time, values(time, 0), values(time, 1), values(time, 2)};
  const Demonstration even = demo.resample(250.0);
  EXPECT_EQ(even.samples(), std::lround(demo.duration() * 250.0) + 1);
  EXPECT_EQ(even.time(0), time(0));
  EXPECT_EQ(even.time(even.samples() - 1), time(199));
  const double step = even.duration() / (even.samples() - 1);
  for (int i = 1; i < even.samples(); ++i)
    EXPECT_NEAR(even.time(i) - even.time(i - 1), step, 1e-12);
  EXPECT_LT((even.position - values(even.time, 0)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((even.velocity - values(even.time, 1)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((even.acceleration - values(even.time, 2)).cwiseAbs().maxCoeff(), 1e-2);
  EXPECT_EQ(refusal([&] { demo.resample(1.0); }),
            "demonstration: rate 1.000000 1/s, must be > 0 and give >= 5 samples");
  EXPECT_THAT(refusal([&] { demo.resample(-5.0); }), testing::HasSubstr("rate -5.000000"));
}

TEST(Demonstration, ChecksItsCoordinatesAgainstARobots) {
  const auto demo = Demonstration::read(std::string(SEAM_ASSETS) + "/demos/ramp_up.csv");
  demo.require_coordinates({"S1", "E1"});
  EXPECT_THAT(refusal([&] {
                demo.require_coordinates({"S1", "S2"});
              }),
              testing::EndsWith("ramp_up.csv: coordinate \"E1\", must be one of S1, S2"));
}

TEST(Demonstration, RefusesBadFiles) {
  const TempFolder folder;
  const auto message = [&](const std::string& content) {
    const std::string path = folder.write("d.csv", content);
    return refusal([&] { Demonstration::read(path); }).substr(path.size());
  };
  EXPECT_EQ(message(""), ":1: no header");
  EXPECT_EQ(message("t,a\n0,0\n"), ":1: first column \"t\", must be \"time\" [s]");
  const std::string falls =
      "column \"time\": does not increase, must be later than the line before";
  EXPECT_EQ(message("time,a\n0,0\n1,0\n1,0\n"), ":4: " + falls);
  EXPECT_EQ(message("time,a\n0,0\n1,0\n0.5,0\n"), ":4: " + falls);
  EXPECT_EQ(message("time,a\n0,0\n1,nan\n"), ":3: column \"a\": \"nan\", must be a finite number");
  EXPECT_EQ(message("time,a\n0,0\n1,0\n"), ": 2 samples, must be >= 5");
  EXPECT_EQ(message("time\n0\n1\n2\n3\n4\n"), ": no coordinates");
  EXPECT_EQ(message("time,a,b,vel.a\n0,0,0,0\n"),
            ":1: no column \"vel.b\", must be there as \"vel.a\" is");
  EXPECT_EQ(message("time,a,acc.q\n0,0,0\n"),
            ":1: column \"acc.q\": no coordinate \"q\", must have one");
  EXPECT_EQ(message("time,a\n-1.7e308,0\n-1e308,0\n0,0\n1e308,0\n1.7e308,0\n"),
            ": lasts inf s, must be in 1e-06 to 1e+09");
  EXPECT_EQ(message("time,a\n0,0\n1e-323,0\n2e-323,0\n3e-323,0\n4e-323,0\n"),
            ": lasts 3.95253e-323 s, must be in 1e-06 to 1e+09");
  EXPECT_EQ(message("time,a\n0,0\n1,0\n2,0\n3,-2e300\n4,0\n"),
            ": a position is -2e+300, must be in -1e+30 to 1e+30");
}

TEST(Demonstration, RefusesBadSettingsAndSamples) {
  const Eigen::VectorXd time = uneven_times(20, 10.0);
  const auto make = [&](std::vector<std::string> names, const Eigen::VectorXd& t, double cutoff) {
    return refusal(
        [&] { Demonstration::from_positions(names, t, Eigen::MatrixXd::Zero(20, 2), {cutoff}); });
  };
  EXPECT_EQ(make({"a", "b"}, time, 0.0), "derivatives: cutoff 0.000000 Hz, must be > 0");
  EXPECT_EQ(make({"a", "a"}, time, 6.0), "demonstration: coordinate names repeat");
  EXPECT_EQ(make({"a"}, time, 6.0), "demonstration: positions must be samples x coordinates");
  Eigen::VectorXd bad = time;
  bad(3) = bad(2);
  EXPECT_THAT(make({"a", "b"}, bad, 6.0), testing::HasSubstr("sample 4: time"));
  bad(3) = std::nan("");
  EXPECT_EQ(make({"a", "b"}, bad, 6.0), "demonstration: a time or position is not finite");
}

}  // namespace
}  // namespace seam
