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
      run("metrics " + folder.path("full.csv") + " --half " + folder.path("half.csv") + " --dmp2 " +
          folder.path("full.csv") + " --urdf " SEAM_ASSETS "/pa10/pa10.urdf");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("2 joints, 20 ticks of 10 ms, 1 joins"),
                                    HasSubstr("| 0.1      | E1 "),
                                    HasSubstr("| torque jump [N·m]                 |       3 |"),
                                    HasSubstr("| torque jump, order in dt          |    0.00 |"),
                                    HasSubstr("| tracking, max [rad]               | 4.8e-02 |"),
                                    HasSubstr("| deviation, peak [rad]             |   0.000 |")));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("not measured")));
}

TEST(MetricsCommand, PrintsJson) {
  const Recordings folder;
  const Outcome outcome = run("metrics --json --join 0.05,0.1 " + folder.path("full.csv"));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const auto json = nlohmann::json::parse(outcome.output);
  ASSERT_EQ(json["joins"].size(), 2U);
  EXPECT_EQ(json["joins"][1]["time"], 0.1);
  EXPECT_NEAR(json["joins"][1]["metrics"]["torque_jump_nm"], 3.0, 1e-12);
  EXPECT_TRUE(json["metrics"]["torque_jump_percent"].is_null());
}

TEST(MetricsCommand, SaysWhatItCouldNotMeasure) {
  const Recordings folder;
  const Outcome outcome = run("metrics " + folder.path("torque.csv"));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("0 joins"), HasSubstr("not measured: torque_jump")));
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
        BadCall{"JoinBeyondTheEnd", "metrics @full.csv --join 7",
                "--join: 7 s, must be within the recording, 0 to 0.19 s"},
        BadCall{"JoinThatIsNoTime", "metrics @full.csv --join nan", "--join: nan s"},
        BadCall{"HalfThatIsNone", "metrics @full.csv --half @full.csv",
                "full.csv: a tick of 0.01 s, must be 0.005 s"},
        BadCall{"OtherJoints", "metrics @full.csv --dmp2 @torque.csv", "deviation: the two runs"},
        BadCall{"NoUrdf", "metrics @full.csv --urdf @none.urdf", "none.urdf"},
        BadCall{"OtherRobot", "metrics @torque.csv --urdf " SEAM_ASSETS "/pa10/pa10.urdf",
                "\"a\""}),
    test::by_name);

}  // namespace
}  // namespace seam
