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
  recording.joins.push_back({0.1});
  const RunMetrics metrics = measure(recording);
  EXPECT_NEAR(metrics.torque_jump_nm, 1.5, 1e-12);
  EXPECT_NEAR(metrics.torque_rate_peak_nm_s, 150.0, 1e-9);
  for (const double unmeasured :
       {metrics.torque_jump_percent, metrics.acceleration_jump_rad_s2, metrics.jerk_peak_rad_s3,
        metrics.tracking_max_rad, metrics.tracking_after_join_max_rad, metrics.saturated_share,
        metrics.tool_tracking_max_m, metrics.deviation_peak_rad})
    EXPECT_TRUE(std::isnan(unmeasured));
}

// What `seam rollout` writes.
TEST(Recording, OfReferencesAloneIsThatOfJointsOrOfATool) {
  const TempFolder folder;
  const auto read = [&](const std::string& header) {
    return Recording::read(folder.write("r.csv", header + "\n0,-1,1,2,3\n0.1,0,1,2,3\n"));
  };
  const Recording joints = read("time,switch,ref.a,ref_vel.a,ref_acc.a");
  EXPECT_EQ(joints.joints, std::vector<std::string>{"a"});
  EXPECT_EQ(joints.ref_acc(0, 0), 3.0);
  EXPECT_FALSE(joints.in_task_space());
  EXPECT_EQ(joints.joins.at(0).primitive, 0);
  const Recording tool = read("time,switch,ref.x,ref.y,ref.z");
  EXPECT_TRUE(tool.joints.empty());
  EXPECT_EQ(tool.tool_ref(1, 2), 3.0);
}

// A clock in microseconds, of a recorder at 3 kHz.
TEST(Recording, TakesAClockThatIsWrittenWithFewDigits) {
  const TempFolder folder;
  std::string text = "time,torque.a\n";
  for (int k = 0; k < 3000; ++k) text += std::to_string(k / 3000.0) + (k < 1500 ? ",0\n" : ",1\n");
  Recording recording = Recording::read(folder.write("r.csv", text));
  EXPECT_NEAR(recording.dt(), 1.0 / 3000.0, 1e-9);
  recording.joins.push_back({0.5});
  EXPECT_NEAR(measure(recording).torque_jump_nm, 1.0, 1e-12);
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
        BadFile{"NoColumnOfARecording", "q.a,q.b,torque.a,torque.b", "a,b,c,d",
                ":1: needs columns torque.<joint> [N·m], or others of a recording"},
        BadFile{"PositionOfOneJoint", "q.b", "qb",
                ":1: needs the column \"q.b\", as of the others"},
        BadFile{"PositionOfTheOther", "q.a", "qa",
                ":1: needs the column \"q.a\", as of the others"},
        BadFile{"ReferenceOfNoJoint", "q.a,q.b", "ref.c,q",
                ":1: reference of \"c\", must be of a joint that has q, qd or torque, or all be"},
        BadFile{"UnevenTime", "\n0.1,", "\n0.05,", ":3: column \"time\": a tick of 0.05"},
        BadFile{"TimeThatFalls", "\n0.2,", "\n0.0,",
                ":4: column \"time\": a tick of -0.1 s, must be 0.1 s as most are"},
        BadFile{"TimeThatStands", "0.1,0,1,2,3,4\n0.2,1,1,2,3,4\n", "0,0,1,2,3,4\n",
                ":3: column \"time\": a tick of 0 s, must be > 0"},
        BadFile{"SwitchBetweenPrimitives", "0.2,1,", "0.2,0.5,",
                ":4: column \"switch\": 0.5, must be a whole number"},
        BadFile{"OneRow", "0.1,0,1,2,3,4\n0.2,1,1,2,3,4\n", "", ": 1 row, must be at least 2"},
        BadFile{"NotANumber", "0.2,1,1", "0.2,1,nan", ":4: column \"q.a\": \"nan\", must be"},
        BadFile{"FieldMissing", "0.2,1,1", "0.2,1", ":4: 5 fields, must be 6"}),
    test::by_name);

}  // namespace
}  // namespace seam
