#include <gmock/gmock.h>

#include "tests/refusals.hpp"
#include <seam/metrics.hpp>
#include <seam/recording.hpp>

namespace seam {
namespace {

using test::BadFile;

Recording some_recording(std::vector<std::string> coordinates = {}) {
  Recording recording({"a", "b"}, Eigen::Vector2d(10.0, 4.0), 20, std::move(coordinates));
  recording.time.setLinSpaced(20, 0.0, 0.19);
  for (Eigen::MatrixXd* block :
       {&recording.ref, &recording.ref_vel, &recording.ref_acc, &recording.q, &recording.qd,
        &recording.torque, &recording.tool_ref, &recording.tool_vel, &recording.tool_acc})
    block->setRandom();
  recording.running.tail(10).setOnes();
  return recording;
}

TEST(Recording, IsWrittenWithTheColumnsOfTheFormat) {
  const TempFolder folder;
  some_recording().write(folder.path("r.csv"));
  const std::string text = test::read_file(folder.path("r.csv"));
  EXPECT_THAT(text, testing::StartsWith(
                        "time,switch,ref.a,ref.b,ref_vel.a,ref_vel.b,ref_acc.a,ref_acc.b,q.a,q.b,"
                        "qd.a,qd.b,torque.a,torque.b\n0,0,"));
}

TEST(Recording, IsReadAsItWasWritten) {
  const TempFolder folder;
  for (const auto& coordinates : {std::vector<std::string>{}, {"x", "y", "z"}}) {
    Recording recording = some_recording(coordinates);
    recording.signals.push_back({"wave_m", Eigen::VectorXd::Random(20)});
    recording.write(folder.path("r.csv"));
    const Recording read = Recording::read(folder.path("r.csv"));
    read.write(folder.path("again.csv"));
    EXPECT_EQ(test::read_file(folder.path("r.csv")), test::read_file(folder.path("again.csv")));
    EXPECT_EQ(read.joints, recording.joints);
    EXPECT_EQ(read.coordinates, coordinates);
    EXPECT_EQ(read.torque, recording.torque);
    EXPECT_EQ(read.tool_acc, recording.tool_acc);
    EXPECT_EQ(read.signals.at(0).values, recording.signals[0].values);
    ASSERT_EQ(read.joins.size(), 1U);
    EXPECT_EQ(read.joins[0].time, recording.time(10));
    EXPECT_EQ(read.joins[0].primitive, 1);
    EXPECT_TRUE(read.effort.array().isNaN().all());
  }
}

TEST(Recording, OfTimeAndTorqueAloneIsMeasuredAsFarAsItGoes) {
  const TempFolder folder;
  std::string text = "time,torque.elbow\n";
  for (int k = 0; k < 20; ++k) text += std::to_string(0.01 * k) + (k < 10 ? ",0\n" : ",1.5\n");
  Recording recording = Recording::read(folder.write("r.csv", text));
  EXPECT_TRUE(recording.joins.empty());
  recording.joins.push_back(recording.estimated_join(0.1, 0));
  const RunMetrics metrics = measure(recording);
  EXPECT_NEAR(metrics.torque_jump_nm, 1.5, 1e-12);
  EXPECT_NEAR(metrics.torque_rate_peak_nm_s, 150.0, 1e-9);
  for (const double unmeasured :
       {metrics.torque_jump_percent, metrics.acceleration_jump_rad_s2, metrics.jerk_peak_rad_s3,
        metrics.tracking_max_rad, metrics.tracking_after_join_max_rad, metrics.saturated_share,
        metrics.tool_tracking_max_m, metrics.deviation_peak_rad})
    EXPECT_TRUE(std::isnan(unmeasured));
}

TEST(Recording, EstimatesTheStepInAccelerationAtAJoin) {
  Recording recording = some_recording({"x", "y", "z"});
  recording.ref_acc.setZero();
  recording.ref_acc.col(1).tail(10).setConstant(-3.0);
  recording.tool_acc.setZero();
  recording.tool_acc.col(2).tail(10).setConstant(0.5);
  const RecordedJoin join = recording.estimated_join(0.1, 1);
  EXPECT_NEAR(join.acceleration_jump, 3.0, 1e-12);
  EXPECT_NEAR(join.linear_jump, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(recording.estimated_join(0.01, 1).acceleration_jump));
}

class RecordingRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(RecordingRefuses, WithFileAndPlace) {
  const std::string good =
      "time,switch,q.a,q.b,torque.a,torque.b\n0,0,1,2,3,4\n0.1,0,1,2,3,4\n0.2,1,1,2,3,4\n";
  test::expect_refused(GetParam(), good, TempFolder(),
                       [](const std::string& path) { Recording::read(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , RecordingRefuses,
    testing::Values(
        BadFile{"NoTime", "time,", "clock,", ":1: column \"clock\", must be time [s]"},
        BadFile{"NoTorque", "torque.a,torque.b", "x,y",
                ":1: needs a column torque.<joint> [N·m] for each joint"},
        BadFile{"PositionOfOneJoint", "q.b", "qb", ": needs the column \"q.b\", as of the others"},
        BadFile{"PositionOfTheOther", "q.a", "qa", ": needs a column \"q.a\", as of the others"},
        BadFile{"ReferenceOfNoJoint", "q.a,q.b", "ref.c,q",
                ":1: column \"ref.c\" is of none of the joints that have a torque"},
        BadFile{"UnevenTime", "\n0.1,", "\n0.05,", ":3: column \"time\": a tick of 0.05"},
        BadFile{"TimeThatFalls", "\n0.2,", "\n0.0,", ":3: column \"time\": a tick of 0.1"},
        BadFile{"TimeThatStands", "0.1,0,1,2,3,4\n0.2,1,1,2,3,4\n", "0,0,1,2,3,4\n",
                ":3: column \"time\": a tick of 0.000000 s"},
        BadFile{"OneRow", "0.1,0,1,2,3,4\n0.2,1,1,2,3,4\n", "", ": 1 row, must be at least 2"},
        BadFile{"NotANumber", "0.2,1,1", "0.2,1,nan", ":4: column \"q.a\": \"nan\", must be"},
        BadFile{"FieldMissing", "0.2,1,1", "0.2,1", ":4: 5 fields, must be 6"}),
    test::by_name);

}  // namespace
}  // namespace seam
