// `seam metrics` as a user calls it.

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/refusals.hpp"
#include <seam/recording.hpp>

namespace seam {
namespace {

using test::BadCall;
using test::Outcome;
using test::run;
using testing::AllOf;
using testing::HasSubstr;

// The torque of E1 steps by -3 N·m at 0.1 s.
struct Recordings : TempFolder {
  Recordings() {
    for (const auto& [name, dt] : {std::pair{"full.csv", 0.01}, {"half.csv", 0.005}}) {
      const int ticks = static_cast<int>(0.2 / dt);
      Recording recording({"S1", "E1"}, Eigen::Vector2d(1.0, 1.0), ticks);
      for (int k = 0; k < ticks; ++k) {
        recording.time(k) = k * dt;
        recording.running(k) = 2 * k >= ticks;
        recording.torque(k, 1) = recording.running(k) ? -3.0 : 0.0;
        recording.ref(k, 0) = 0.25 * recording.time(k);
      }
      recording.write(path(name));
    }
    write("torque.csv", "time,torque.a\n0,1\n0.1,1\n0.2,1\n0.3,1\n");
    write("nan.csv", "time,torque.a\n0,1\n0.1,nan\n");
    write("empty.csv", "");
  }
};

TEST(MetricsCommand, FindsTheJoinsAndMeasuresThem) {
  const Recordings folder;
  const Outcome outcome =
      run("metrics " + folder.path("full.csv") + " --half " + folder.path("half.csv") +
          " --compare " + folder.path("full.csv") + " --urdf " SEAM_ASSETS "/pa10/pa10.urdf");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(
      outcome.output,
      AllOf(HasSubstr("2 joints, 20 ticks of 10 ms, 1 join\n"), HasSubstr("| 0.1      | E1 "),
            HasSubstr("| torque jump [N·m]                     |       3 |"),
            HasSubstr("| torque jump, order in dt              |    0.00 |"),
            HasSubstr("| tracking, max [rad]                   | 4.8e-02 |"),
            HasSubstr("| deviation, peak [rad]                 |   0.000 |")));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("not measured")));
}

TEST(MetricsCommand, PrintsJson) {
  const Recordings folder;
  const Outcome outcome = run("metrics --json --join 0.05,0.1 " + folder.path("full.csv"));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const auto json = nlohmann::json::parse(outcome.output);
  ASSERT_EQ(json["joins"].size(), 2U);
  EXPECT_EQ(json["joins"][1]["time"], 0.1);
  EXPECT_EQ(json["joins"][1]["joint"], "E1");
  EXPECT_NEAR(json["joins"][1]["metrics"]["torque_jump_nm"], 3.0, 1e-12);
  EXPECT_TRUE(json["metrics"]["torque_jump_percent"].is_null());
}

TEST(MetricsCommand, SaysWhatItCouldNotMeasureAndWhatThatNeeds) {
  const Recordings folder;
  const Outcome outcome = run("metrics " + folder.path("torque.csv"));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(
      outcome.output,
      AllOf(HasSubstr("1 joint, 4 ticks of 100 ms, 0 joins"),
            HasSubstr("not measured, needs a join (--join, or a column switch that changes):\n"
                      "  torque_jump_nm, torque_jump_percent, torque_jump_order\n"),
            HasSubstr("needs the joints' effort limits (--urdf):\n  saturated_share\n"),
            HasSubstr("needs columns ref.<joint> and q.<joint>:\n  tracking_rms_rad, "),
            HasSubstr("needs another run (--compare):\n  deviation_peak_rad, deviation_faded_s\n"),
            testing::Not(HasSubstr("n/a"))));
  EXPECT_THAT(run("metrics " + folder.path("torque.csv") + " --join 0.1").output,
              HasSubstr("needs more ticks to either side of every join:\n  torque_jump_nm\n"));
}

std::string row(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + std::to_string(value);
  return text + '\n';
}

TEST(MetricsCommand, MeasuresWhatARolloutWrites) {
  const Recordings folder;
  std::string text = "time,switch,ref.z,ref_vel.z,ref_acc.z\n";
  for (int k = 0; k < 20; ++k) text += row({0.01 * k, 1.0 * (k / 10), 0.0, 0.0, 7.0 * (k / 10)});
  const Outcome outcome = run("metrics --json " + folder.write("rollout.csv", text));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const auto json = nlohmann::json::parse(outcome.output);
  EXPECT_NEAR(json["metrics"]["acceleration_jump_m_s2"].get<double>(), 7.0, 1e-12);
  EXPECT_FALSE(json["metrics"].contains("acceleration_jump_rad_s2"));  // z is in metres
  EXPECT_NEAR(json["metrics"]["jerk_peak_rad_s3"].get<double>(), 700.0, 1e-9);
  EXPECT_THAT(
      run("metrics " + folder.path("rollout.csv")).output,
      AllOf(HasSubstr("| acceleration jump, estimated [m/s²] "), HasSubstr("| jerk, peak [m/s³] "),
            HasSubstr("| estimate off by about [m/s²] "), testing::Not(HasSubstr("[rad"))));
}

// A smooth acceleration has an error as large as the jump that is estimated, a step has none.
TEST(MetricsCommand, SaysHowFarAnEstimatedJumpMayBeOff) {
  const Recordings folder;
  std::string text = "time,switch,ref.a,ref_acc.a,ref.z,ref_acc.z\n";
  for (int k = 0; k < 40; ++k) {
    const double t = 0.01 * (k - 20);
    text += row({0.01 * k, 1.0 * (k / 20), 0.0, (k < 20 ? -3e3 : 3e3) * t * t * 0.5, 0.0,
                 k < 20 ? 0.0 : 7.0});
  }
  const std::string path = folder.write("both.csv", text);
  const auto json =
      nlohmann::json::parse(run("metrics --json " + path).output)["joins"][0]["metrics"];
  const double bend = 4.0 + 1.0 / 6.0;  // of seam/metrics.hpp's formula for n = 3: c = 3
  EXPECT_NEAR(json["acceleration_jump_rad_s2"].get<double>(), bend * 1e-4 * 6e3, 1e-3);
  EXPECT_NEAR(json["acceleration_jump_error_rad_s2"].get<double>(), bend * 1e-4 * 6e3, 1e-3);
  EXPECT_NEAR(json["acceleration_jump_m_s2"].get<double>(), 7.0, 1e-9);
  EXPECT_NEAR(json["acceleration_jump_error_m_s2"].get<double>(), 0.0, 1e-9);
}

// A recording tells from its file what it told the bench; but the acceleration's jumps are estimated.
TEST(MetricsCommand, FindsInAFileWhatTheBenchMeasured) {
  const TempFolder folder;
  ASSERT_EQ(run("bench line --method dmp2,dmp3 --out " + folder.path("")).status, 0);
  const auto summary = nlohmann::json::parse(test::read_file(folder.path("summary.json")));
  const Outcome outcome =
      run("metrics --json " + folder.path("line/dmp3.csv") + " --compare " +
          folder.path("line/dmp2.csv") + " --urdf " SEAM_ASSETS "/pa10/pa10.urdf");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const auto json = nlohmann::json::parse(outcome.output);
  const auto& bench = summary["runs"][1];
  ASSERT_EQ(bench["method"], "dmp3");
  ASSERT_EQ(json["joins"].size(), bench["joins"].size());
  for (const auto& [metric, value] : bench["metrics"].items()) {
    if (metric == "torque_jump_order" || metric == "stopped_share" || metric == "limited_share")
      continue;  // not in a file
    const double tolerance = metric == "acceleration_jump_rad_s2" ? 0.1 : 1e-9;
    EXPECT_NEAR(json["metrics"][metric].get<double>(), value.get<double>(), tolerance) << metric;
  }
}

TEST(MetricsCommand, FitsLongerLines) {
  const Recordings folder;
  std::string text = "time,torque.a\n";
  for (int k = 0; k < 200; ++k) text += row({0.01 * k, k / 100 + (k == 97 ? 0.3 : 0.0)});
  const std::string call = "metrics --json --join 1 " + folder.write("spike.csv", text);
  const auto jump = [&](const std::string& settings) {
    const auto json = nlohmann::json::parse(run(call + settings).output);
    return json["metrics"]["torque_jump_nm"].get<double>();
  };
  EXPECT_NEAR(jump(""), 0.9, 1e-9);
  EXPECT_NEAR(jump(" --line-ticks 90"), 1.0, 0.02);
}

TEST(MetricsCommand, Helps) {
  const Outcome outcome = run("metrics --help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("Example: seam metrics "), HasSubstr("[s]")));
}

class MetricsCommandRefuses : public testing::TestWithParam<BadCall> {};

TEST_P(MetricsCommandRefuses, WithOneLineAndExitCodeTwo) {
  test::expect_refused(GetParam(), Recordings());
}

INSTANTIATE_TEST_SUITE_P(
    , MetricsCommandRefuses,
    testing::Values(
        BadCall{"NoRecording", "metrics", "recording is required"},
        BadCall{"NoFile", "metrics @none.csv", "none.csv: "},
        BadCall{"EmptyFile", "metrics @empty.csv", "empty.csv"},
        BadCall{"NotANumber", "metrics @nan.csv", "nan.csv:3: column \"torque.a\": \"nan\""},
        BadCall{"JoinBeyondTheEnd", "metrics @full.csv --join 7", "full.csv, 0 to 0.19 s"},
        BadCall{"JoinThatIsNoTime", "metrics @full.csv --join nan",
                "--join: nan, must be a finite number"},
        BadCall{"HalfThatIsNone", "metrics @full.csv --half @full.csv",
                "full.csv: a tick of 0.01 s, must be 0.005 s"},
        BadCall{"OtherJoints", "metrics @full.csv --compare @torque.csv",
                "torque.csv: 4 ticks, must be 20 as "},
        BadCall{"OneTickAsALine", "metrics @full.csv --line-ticks 1", "--line-ticks"},
        BadCall{"NegativeWindow", "metrics @full.csv --after-join -1", "--after-join"},
        BadCall{"NoUrdf", "metrics @full.csv --urdf @none.urdf", "none.urdf"},
        BadCall{"OtherRobot", "metrics @torque.csv --urdf " SEAM_ASSETS "/pa10/pa10.urdf",
                "\"a\""}),
    test::by_name);

}  // namespace
}  // namespace seam
