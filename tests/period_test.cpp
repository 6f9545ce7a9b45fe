#include <random>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/period.hpp>

namespace seam {
namespace {

using test::refusal;

Demonstration sampled(double duration, double rate,
                      const std::function<Eigen::RowVector2d(double)>& curve,
                      unsigned jitter_seed = 1) {
  std::mt19937_64 random(jitter_seed);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  const auto N = static_cast<int>(std::lround(duration * rate)) + 1;
  Eigen::VectorXd time(N);
  Eigen::MatrixXd position(N, 2);
  for (int i = 0; i < N; ++i) {
    time(i) = (i + jitter(random)) / rate;
    position.row(i) = curve(time(i));
  }
  return Demonstration::from_positions({"x", "y"}, time, position);
}

Eigen::RowVector2d eight(double t, double period) {
  const double p = 2.0 * M_PI * t / period;
  return {0.5 + 0.10 * std::cos(p) + 0.02 * std::sin(3.0 * p), -0.2 + 0.05 * std::sin(2.0 * p)};
}

TEST(Period, IsFoundToTheLastDigitsWithoutNoise) {
  for (const double period : {0.25, 1.2, 3.7})
    for (const double cycles : {2.2, 3.0, 17.4}) {
      const auto demo = sampled(cycles * period, 120.0, [=](double t) { return eight(t, period); });
      EXPECT_NEAR(find_period(demo), period, 1e-7 * period) << period << " s x " << cycles;
    }
}

TEST(Period, IsFoundUnderNoise) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 0.015);
    const auto demo = sampled(
        6.3, 120.0,
        [&](double t) {
          return Eigen::RowVector2d(eight(t, 1.2) +
                                    Eigen::RowVector2d(noise(random), noise(random)));
        },
        seed);
    EXPECT_NEAR(find_period(demo), 1.2, 0.005) << "seed " << seed;
  }
}

TEST(Period, IsFoundOverThousandsOfCycles) {
  const auto demo = sampled(1000.0, 100.0, [](double t) { return eight(t, 0.731); });
  EXPECT_NEAR(find_period(demo), 0.731, 1e-8);
}

TEST(Period, IsRefusedWhereThereIsNone) {
  const std::string none = "demonstration: no period found, must show two or more (or give it)";
  const auto message = [](const std::function<Eigen::RowVector2d(double)>& curve,
                          double duration = 4.0) {
    return refusal([&] { find_period(sampled(duration, 100.0, curve)); });
  };
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  Eigen::RowVector2d walk(0.0, 0.0);
  EXPECT_EQ(message([](double t) { return Eigen::RowVector2d(t, -t); }), none);
  EXPECT_EQ(message([](double) { return Eigen::RowVector2d(1.0, 2.0); }), none);
  EXPECT_EQ(message([&](double) { return Eigen::RowVector2d(noise(random), 0.0); }), none);
  EXPECT_EQ(message([&](double) { return walk += Eigen::RowVector2d(noise(random), 0.0); }), none);
  EXPECT_EQ(message([](double t) { return eight(t, 1.0); }, 1.5), none);
}

TEST(Period, TheCentreNeedsNeitherWholePeriodsNorEvenTimes) {
  for (const double cycles : {1.0, 1.3, 4.7}) {
    const auto demo = sampled(cycles * 1.2, 120.0, [](double t) { return eight(t, 1.2); });
    EXPECT_LT((find_centre(demo, 1.2) - Eigen::Vector2d(0.5, -0.2)).norm(), 1e-10) << cycles;
  }
}

}  // namespace
}  // namespace seam
