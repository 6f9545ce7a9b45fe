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

TEST(TorqueJump, IsNotANumberTooCloseToAnEnd) {
  Recording recording = recording_of(1e-3, [](double t) { return t; });
  recording.joins[0].time = 2e-3;
  EXPECT_TRUE(std::isnan(measure(recording, recording.joins[0]).torque_jump_nm));
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

TEST(Deviation, IsTheLargestDistanceOfTheReferences) {
  Recording a = recording_of(1e-2, [](double) { return 0.0; });
  Recording b = a;
  b.ref(40, 1) = -0.25;
  EXPECT_DOUBLE_EQ(deviation_peak(a, b), 0.25);
  EXPECT_EQ(
      test::refusal([&] { deviation_peak(a, Recording({"a"}, Eigen::VectorXd::Ones(1), 5)); }),
      "deviation: the two runs differ in ticks or joints");
}

TEST(Recording, IsWrittenWithTheColumnsOfTheFormat) {
  const TempFolder folder;
  recording_of(0.1, [](double t) { return t; }).write(folder.path("r.csv"));
  const std::string text = test::read_file(folder.path("r.csv"));
  EXPECT_THAT(text, testing::StartsWith(
                        "time,switch,ref.a,ref.b,ref_vel.a,ref_vel.b,ref_acc.a,ref_acc.b,q.a,q.b,"
                        "qd.a,qd.b,torque.a,torque.b\n0,0,"));
}

}  // namespace
}  // namespace seam
