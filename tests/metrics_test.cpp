#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/metrics.hpp>

namespace seam {
namespace {

constexpr double join = 0.5;

Recording recording_of(double dt, const std::function<double(double)>& torque) {
  Recording recording({"a", "b"}, Eigen::Vector2d(10.0, 4.0), static_cast<int>(1.0 / dt));
  for (int k = 0; k < recording.ticks(); ++k) {
    recording.time(k) = k * dt;
    recording.torque(k, 1) = torque(k * dt);
  }
  recording.joins.push_back({join, 1, 3.0});
  return recording;
}

double jump_at(double dt, const std::function<double(double)>& torque) {
  return measure(recording_of(dt, torque)).torque_jump_nm;
}

double order_of(const std::function<double(double)>& torque) {
  return jump_order(jump_at(1e-3, torque), jump_at(5e-4, torque));
}

TEST(TorqueJump, FindsAStepOnASlopeWhole) {
  const auto step = [](double t) { return 3.0 * t + std::sin(t) + (t < join ? 0.0 : 1.0); };
  EXPECT_NEAR(jump_at(1e-3, step), 1.0, 0.01);
  EXPECT_NEAR(order_of(step), 0.0, 0.01);
}

TEST(TorqueJump, DoesNotSeeTheTicksNextToTheJoin) {
  const auto spike = [](double t) { return std::abs(t - join) < 1.5e-3 ? 100.0 : 0.0; };
  EXPECT_NEAR(jump_at(1e-3, spike), 0.0, 1e-12);
}

TEST(TorqueJump, OfAKinkVanishesAndOfASmoothSignalHasOrderTwo) {
  EXPECT_LT(jump_at(1e-3, [](double t) { return 40.0 * std::abs(t - join); }), 1e-10);
  EXPECT_NEAR(order_of([](double t) {
                return std::sin(20.0 * t) + (t < join ? 0.0 : 300.0 * (t - join) * (t - join));
              }),
              2.0, 0.1);
}

TEST(TorqueJump, IsFoundAtAJoinBetweenTwoTicks) {
  const double at = join + 0.0004;
  Recording recording =
      recording_of(1e-3, [&](double t) { return 5.0 * t + (t < at ? 0.0 : 2.0); });
  recording.joins[0].time = at;
  EXPECT_NEAR(measure(recording).torque_jump_nm, 2.0, 1e-9);
}

TEST(TorqueJump, IsAShareOfTheJointsEffortLimit) {
  const auto recording = recording_of(1e-3, [](double t) { return t < join ? 0.0 : 1.0; });
  EXPECT_NEAR(measure(recording).torque_jump_percent, 25.0, 1e-9);
  EXPECT_EQ(measure(recording).acceleration_jump_rad_s2, 3.0);
}

TEST(TorqueJump, NamesTheJointThatStepsMost) {
  Recording recording = recording_of(1e-3, [](double t) { return t < join ? 0.0 : 1.0; });
  EXPECT_EQ(measure(recording).joins[0].joint, 1);
  for (int k = recording.ticks() / 2; k < recording.ticks(); ++k) recording.torque(k, 0) = -2.0;
  EXPECT_EQ(measure(recording).joins[0].joint, 0);
  EXPECT_NEAR(measure(recording).torque_jump_nm, 2.0, 1e-9);
}

// Of a smooth torque with a step, with noise of 1 mN·m; the estimate's deviation is 3.1 times the noise's.
TEST(TorqueJump, FindsAStepToOnePercentInNoiseAndAtAnyTick) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (const double dt : {2e-3, 1e-3, 5e-4, 1e-4}) {
    const auto step = [](double t) { return 2.0 * std::sin(3.0 * t) + (t < join ? 0.0 : 1.0); };
    EXPECT_NEAR(jump_at(dt, step), 1.0, 0.01) << dt;
  }
  double square = 0.0;
  constexpr int trials = 400;
  for (int i = 0; i < trials; ++i) {
    const double found =
        jump_at(1e-3, [&](double t) { return (t < join ? 0.0 : 1.0) + noise(random); });
    square += (found - 1.0) * (found - 1.0) / trials;
  }
  EXPECT_NEAR(std::sqrt(square), 3.1e-3, 0.4e-3);
  EXPECT_LT(std::sqrt(square), 0.01);
}

// A recorded join may be late by a part of a tick: what is held over the tick is found at its beginning.
TEST(TorqueJump, OfAKinkHasOrderOneWhereItsTimeIsOffByAPartOfATick) {
  const auto jump_of = [](double dt, const std::function<double(double)>& torque) {
    Recording recording = recording_of(dt, torque);
    recording.joins[0].time += 0.3 * dt;
    return measure(recording).torque_jump_nm;
  };
  const auto order = [&](const std::function<double(double)>& torque) {
    return jump_order(jump_of(1e-3, torque), jump_of(5e-4, torque));
  };
  EXPECT_NEAR(order([](double t) { return t < join ? 0.0 : 1.0; }), 0.0, 0.01);
  const double c0 = order([](double t) { return std::sin(9.0 * t) + 20.0 * std::abs(t - join); });
  EXPECT_GE(c0, 0.9);
  EXPECT_LT(c0, 1.2);
  EXPECT_GE(order([](double t) {
              return std::sin(9.0 * t) + (t < join ? 0.0 : 300.0 * (t - join) * (t - join));
            }),
            1.9);
}

TEST(TorqueJump, OrderComesFromTheRunAtHalfTheTick) {
  const auto kinked = [](double t) { return t < join ? 0.0 : 300.0 * (t - join) * (t - join); };
  const Recording full = recording_of(1e-3, kinked), half = recording_of(5e-4, kinked);
  EXPECT_TRUE(std::isnan(measure(full).torque_jump_order));
  const RunMetrics metrics = measure(full, {&half});
  EXPECT_NEAR(metrics.torque_jump_order, 2.0, 0.1);
  EXPECT_EQ(metrics.joins[0].torque_jump_order, metrics.torque_jump_order);
  Recording other = half;
  other.joins[0].time = 0.4;
  EXPECT_EQ(test::refusal([&] { measure(full, {&other}); }),
            "order: the run at half the tick has other joins");
}

TEST(TorqueJump, IsNotANumberTooCloseToAnEnd) {
  Recording recording = recording_of(1e-3, [](double t) { return t; });
  recording.joins[0].time = 2e-3;
  EXPECT_TRUE(std::isnan(measure(recording).joins[0].torque_jump_nm));
}

TEST(TorqueJump, OfARunIsNotANumberWhereOneOfItsJoinsCannotBeMeasured) {
  Recording recording = recording_of(1e-3, [](double t) { return t; });
  recording.joins.push_back({2e-3, 0, 1.0});
  EXPECT_TRUE(std::isnan(measure(recording).torque_jump_nm));
  recording.joins = {{2e-3, 0, 1.0}, {join, 1, 3.0}};
  EXPECT_TRUE(std::isnan(measure(recording).torque_jump_percent));
}

TEST(RunMetrics, OfKnownSignals) {
  Recording recording = recording_of(1e-3, [](double t) { return 7.0 * t; });
  for (int k = 0; k < recording.ticks(); ++k) {
    recording.ref_acc(k, 0) = 2.0 * std::sin(10.0 * recording.time(k));
    recording.q(k, 0) = k % 2 ? 3e-3 : -3e-3;
  }
  const RunMetrics metrics = measure(recording);
  EXPECT_NEAR(metrics.torque_rate_peak_nm_s, 7.0, 1e-9);
  EXPECT_NEAR(metrics.torque_rate_rms_nm_s, 7.0, 1e-9);
  EXPECT_NEAR(metrics.jerk_peak_rad_s3, 20.0, 1e-2);
  EXPECT_NEAR(metrics.jerk_rms_rad_s3, 20.0 / std::sqrt(2.0), 0.4);
  EXPECT_DOUBLE_EQ(metrics.tracking_max_rad, 3e-3);
  EXPECT_NEAR(metrics.tracking_rms_rad, 3e-3, 1e-15);
}

TEST(RunMetrics, TrackingAfterAJoinIsThatOfTheNextFifthOfASecond) {
  Recording recording = recording_of(1e-3, [](double t) { return t; });
  recording.q(static_cast<int>(1e3 * (join - 0.01)), 0) = 5.0;
  recording.q(static_cast<int>(1e3 * (join + 0.1)), 0) = 2.0;
  recording.q(static_cast<int>(1e3 * (join + after_join + 0.01)), 0) = 4.0;
  const RunMetrics metrics = measure(recording);
  EXPECT_EQ(metrics.tracking_max_rad, 5.0);
  EXPECT_EQ(metrics.tracking_after_join_max_rad, 2.0);
  recording.joins.push_back({join + 0.05, 1, 0.0});
  EXPECT_EQ(measure(recording).joins[0].tracking_max_rad, 0.0);
  EXPECT_EQ(measure(recording).joins[1].tracking_max_rad, 4.0);
}

TEST(RunMetrics, CountTheTicksAtTheEffortLimit) {
  const Recording recording = recording_of(1e-3, [](double t) { return t < 0.25 ? -4.0 : 3.9; });
  EXPECT_DOUBLE_EQ(measure(recording).saturated_share, 0.25);
  Recording unlimited = recording;
  unlimited.effort(0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(measure(unlimited).saturated_share));
  EXPECT_TRUE(std::isnan(measure(unlimited).torque_jump_percent));
}

TEST(RunMetrics, OfAToolAreThoseOfItsErrors) {
  Recording recording({"a"}, Eigen::VectorXd::Ones(1), 100, {"x", "y", "z"});
  recording.time.setLinSpaced(100, 0.0, 0.99);
  recording.tool_error_m.setConstant(2e-3);
  recording.tool_error_m(7) = 5e-3;
  recording.tool_error_rad.setConstant(1e-2);
  const RunMetrics metrics = measure(recording);
  EXPECT_DOUBLE_EQ(metrics.tool_tracking_max_m, 5e-3);
  EXPECT_NEAR(metrics.tool_tracking_rms_m, std::sqrt((99 * 4e-6 + 25e-6) / 100.0), 1e-12);
  EXPECT_NEAR(metrics.tool_tracking_rms_rad, 1e-2, 1e-12);
}

// A deviation that grows to 0.2 rad at 0.7 s and dies out exponentially.
TEST(Deviation, HasAPeakAndATimeAfterWhichItHasFaded) {
  const Recording dmp2 = recording_of(1e-3, [](double) { return 0.0; });
  Recording run = dmp2;
  for (int k = 0; k < run.ticks(); ++k) {
    const double t = run.time(k);
    if (t > join) run.ref(k, 1) = t < 0.7 ? t - join : -0.2 * std::exp(-(t - 0.7) / 0.02);
  }
  const RunMetrics metrics = measure(run, {nullptr, &dmp2});
  EXPECT_NEAR(metrics.deviation_peak_rad, 0.2, 1e-9);
  EXPECT_NEAR(metrics.deviation_faded_s, 0.2 - 0.02 * std::log(0.05), 1.1e-3);
  EXPECT_EQ(measure(dmp2, {nullptr, &dmp2}).deviation_peak_rad, 0.0);
  EXPECT_EQ(measure(dmp2, {nullptr, &dmp2}).deviation_faded_s, 0.0);
  run.ref(run.ticks() - 1, 1) = 0.1;
  EXPECT_TRUE(std::isnan(measure(run, {nullptr, &dmp2}).deviation_faded_s));
  const Recording other({"a"}, Eigen::VectorXd::Ones(1), 5);
  EXPECT_EQ(test::refusal([&] {
              measure(run, {nullptr, &other});
            }),
            "deviation: the two runs differ in ticks, joints or coordinates");
}

TEST(Deviation, OfAToolIsADistance) {
  Recording a({"a"}, Eigen::VectorXd::Ones(1), 10, {"x", "y", "z"});
  a.time.setLinSpaced(10, 0.0, 0.9);
  Recording b = a;
  b.tool_ref.row(4) << 0.03, 0.0, -0.04;
  EXPECT_NEAR(measure(b, {nullptr, &a}).deviation_peak_m, 0.05, 1e-15);
}

}  // namespace
}  // namespace seam
