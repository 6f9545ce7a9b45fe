#include <algorithm>
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

// Torques with a corner at the join: the slope changes (C0), or the curvature alone (C1). The curvatures differ on both
// sides, so that what is left of them does not cancel.
double corner(double t, double slope, double curvature) {
  const double s = t - join;
  return std::sin(9.0 * t) + (s < 0.0 ? 40.0 * s * s : slope * s + (40.0 + curvature) * s * s);
}

// How a tick's torque comes to be recorded.
struct Recorder {
  const char* name;
  double late;    // ticks by which the recorded time of the join is late
  double corner;  // ticks by which the join lies behind a tick
  bool mean;      // of the tick, as of a torque that is averaged over it; else at its beginning
};

class TorqueJumpOrder : public testing::TestWithParam<Recorder> {
 protected:
  static double jump_of(double dt, double slope, double curvature) {
    const Recorder& as = GetParam();
    Recording recording = recording_of(dt, [&](double t) {
      const auto at = [&](double s) { return corner(s - as.corner * dt, slope, curvature); };
      return as.mean ? (at(t) + 4.0 * at(t + 0.5 * dt) + at(t + dt)) / 6.0 : at(t);
    });
    recording.joins[0].time = join + (as.corner + as.late) * dt;
    return measure(recording).torque_jump_nm;
  }
  static double order(double slope, double curvature) {
    const double full = jump_of(5e-4, slope, curvature);
    EXPECT_GT(full, 1e-6) << "nothing but rounding is left";
    return jump_order(full, jump_of(2.5e-4, slope, curvature));
  }
};

TEST_P(TorqueJumpOrder, IsAtLeastOneOfAKinkAndTwoWhereTheSlopeIsContinuous) {
  EXPECT_GE(order(20.0, 60.0), 0.9);
  EXPECT_GE(order(0.0, 60.0), 1.9);
  const bool seen_at_its_place = GetParam().late == 0.0 && !GetParam().mean;
  EXPECT_NEAR(order(20.0, 60.0), seen_at_its_place ? 2.0 : 1.0, 0.1);
  EXPECT_NEAR(order(0.0, 60.0), 2.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(, TorqueJumpOrder,
                         testing::Values(Recorder{"OnATick", 0.0, 0.0, false},
                                         Recorder{"BetweenTicks", 0.0, 0.4, false},
                                         Recorder{"LateByPartOfATick", 0.4, 0.0, false},
                                         Recorder{"MeanOfATick", 0.0, 0.0, true},
                                         Recorder{"MeanAndLate", 0.4, 0.0, true}),
                         [](const auto& recorder) { return recorder.param.name; });

TEST(TorqueJump, LeavesOfACurvatureWhatItsFormulaSays) {
  const auto bent = [](double t) { return t < join ? 0.0 : 100.0 * (t - join) * (t - join); };
  const Recording recording = recording_of(1e-3, bent);
  for (const int n : {2, 3, 10, 20}) {
    const double c = 0.5 * (n + 3);
    const double left = 0.5 * std::abs(c * c - (n * n - 1.0) / 12.0) * 1e-6 * 200.0;
    EXPECT_NEAR(measure(recording, {}, {n}).torque_jump_nm, left, 1e-9) << n;
  }
}

// Longer lines: a step of 1 N·m in noise of 10 mN·m.
TEST(TorqueJump, LeavesOfNoiseWhatItsFormulaSays) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 0.01);
  const auto noisy = [&](double t) { return std::sin(t) + (t < join ? 0.0 : 1.0) + noise(random); };
  for (const int n : {3, 20, 100}) {
    const double c = 0.5 * (n + 3);
    const double spread = 0.01 * std::sqrt(2.0 / n + 24.0 * c * c / (n * (1.0 * n * n - 1.0)));
    double mean = 0.0;
    double square = 0.0;
    constexpr int trials = 1000;
    for (int i = 0; i < trials; ++i) {
      const double error = measure(recording_of(1e-3, noisy), {}, {n}).torque_jump_nm - 1.0;
      mean += error / trials;
      square += error * error / trials;
    }
    EXPECT_NEAR(mean, 0.0, 4.0 * spread / std::sqrt(trials)) << n;
    EXPECT_NEAR(std::sqrt(square), spread, 0.1 * spread) << n;
    if (n == 100) {
      EXPECT_LT(3.0 * spread, 0.01);
    }
  }
}

TEST(TorqueJump, IsNotANumberWhereThereIsNothingToMeasure) {
  const Recording recording = recording_of(1e-3, [](double t) { return t; });
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double at : {unknown, infinity, -infinity, 1e300, -1.0})
    EXPECT_TRUE(jump(recording.time, recording.torque, at).array().isNaN().all()) << at;
  EXPECT_EQ(jump(recording.time, Eigen::MatrixXd(), join).size(), 0);
  EXPECT_TRUE(std::isnan(jump(Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1), 1.0)(0)));
  Recording none = recording;
  none.joins.clear();
  EXPECT_TRUE(std::isnan(measure(none).torque_jump_nm));
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
            "recording: has other joins than the run at the whole tick");
  EXPECT_EQ(test::refusal([&] { measure(full, {&full}); }),
            "recording: a tick of 0.001 s, must be 0.0005 s, half of the other's");
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

TEST(TorqueJump, HasNoOrderWhereRoundingIsAllThatIsLeft) {
  const auto straight = [](double t) { return 50.0 + 0.3 * t; };
  const Recording half = recording_of(5e-4, straight);
  const RunMetrics metrics = measure(recording_of(1e-3, straight), {&half});
  EXPECT_LT(metrics.torque_jump_nm, 1e-12);
  EXPECT_TRUE(std::isnan(metrics.torque_jump_order));
}

// Of a recording that does not say by how much the acceleration steps, as one from a file.
TEST(AccelerationJump, IsEstimatedWhereItIsNotRecorded) {
  Recording recording({"a", "b"}, Eigen::Vector2d::Ones(), 100, {"x", "y", "z", "rx", "ry", "rz"});
  recording.time.setLinSpaced(100, 0.0, 0.99);
  recording.joins.push_back({0.5});
  recording.ref_acc.col(1).tail(50).setConstant(-3.0);
  recording.tool_acc.col(2).tail(50).setConstant(0.5);
  recording.tool_acc.col(4).tail(50).setConstant(-2.0);
  EXPECT_NEAR(measure(recording).acceleration_jump_rad_s2, 2.0, 1e-12);
  EXPECT_NEAR(measure(recording).acceleration_jump_m_s2, 0.5, 1e-12);
  recording.coordinates.clear();
  EXPECT_NEAR(measure(recording).acceleration_jump_rad_s2, 3.0, 1e-12);
  EXPECT_TRUE(std::isnan(measure(recording).acceleration_jump_m_s2));
  recording.joins[0].time = 0.01;
  EXPECT_TRUE(std::isnan(measure(recording).acceleration_jump_rad_s2));
}

TEST(RunMetrics, RefuseSettingsThatWillNotDo) {
  const Recording recording = recording_of(1e-3, [](double t) { return t; });
  const auto with = [&](const MetricSettings& settings) {
    return test::refusal([&] { measure(recording, {}, settings); });
  };
  EXPECT_EQ(with({1}), "metrics: line_ticks 1, must be >= 2");
  EXPECT_EQ(with({3, -0.1}), "metrics: after_join -0.1 s, must be >= 0");
  EXPECT_EQ(with({3, 0.2, 1.0}), "metrics: faded_share 1, must be in 0 to 1");
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
  recording.q(static_cast<int>(1e3 * (join + 0.21)), 0) = 4.0;
  const RunMetrics metrics = measure(recording);
  EXPECT_EQ(metrics.tracking_max_rad, 5.0);
  EXPECT_EQ(metrics.tracking_after_join_max_rad, 2.0);
  recording.joins.push_back({join + 0.05, 1, 0.0});
  EXPECT_EQ(measure(recording).joins[0].tracking_max_rad, 0.0);
  EXPECT_EQ(measure(recording).joins[1].tracking_max_rad, 4.0);
  EXPECT_EQ(measure(recording, {}, {3, 0.1}).joins[1].tracking_max_rad, 2.0);
  std::reverse(recording.joins.begin(), recording.joins.end());
  EXPECT_EQ(measure(recording).joins[0].tracking_max_rad, 4.0);
  recording.joins.push_back(recording.joins[0]);  // two at the same time
  EXPECT_EQ(measure(recording).joins[2].tracking_max_rad, 4.0);
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
  recording.joins.push_back({0.5});
  recording.tool_error_rad(65) = 0.04;
  EXPECT_DOUBLE_EQ(measure(recording).tool_tracking_after_join_max_m, 2e-3);
  EXPECT_DOUBLE_EQ(measure(recording).joins[0].tool_tracking_max_rad, 0.04);
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
            "recording: 5 ticks, must be 1000 as recording");
  Recording later = dmp2;
  later.time.array() += 0.1;
  later.source = "later.csv";
  EXPECT_EQ(test::refusal([&] {
              measure(run, {nullptr, &later});
            }),
            "later.csv: tick 1 at 0.1 s, must be at 0 s as recording");
  later = dmp2;
  later.joints[1] = "c";
  EXPECT_EQ(test::refusal([&] {
              measure(run, {nullptr, &later});
            }),
            "recording: other joints or coordinates, must be the same as recording");
}

TEST(Deviation, OfAJoinIsThatUntilTheNext) {
  const Recording dmp2 = recording_of(1e-3, [](double) { return 0.0; });
  Recording run = dmp2;
  run.joins = {{0.2}, {0.4}, {0.8}};
  run.ref.col(0).segment(250, 50).setConstant(-0.1);
  run.ref.col(1).segment(700, 200).setConstant(0.3);
  const RunMetrics metrics = measure(run, {nullptr, &dmp2});
  EXPECT_EQ(metrics.joins[0].deviation_peak_rad, 0.1);
  EXPECT_NEAR(metrics.joins[0].deviation_faded_s, 0.1, 1e-9);
  EXPECT_EQ(metrics.joins[1].deviation_peak_rad, 0.3);
  EXPECT_TRUE(std::isnan(metrics.joins[1].deviation_faded_s));
  EXPECT_NEAR(metrics.joins[2].deviation_faded_s, 0.1, 1e-9);
  EXPECT_EQ(metrics.deviation_peak_rad, 0.3);
  EXPECT_NEAR(metrics.deviation_faded_s, 0.5, 1e-9);
  EXPECT_NEAR(measure(run, {nullptr, &dmp2}, {3, 0.2, 0.5}).joins[0].deviation_faded_s, 0.1, 1e-9);
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
