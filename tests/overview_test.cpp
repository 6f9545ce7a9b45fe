// The overview of a bench: a scene and method a row, on both arms.

#include <gmock/gmock.h>

#include "bench/columns.hpp"

namespace seam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Comparison on(const std::string& arm, double jump, double spilled, double stopped, double limited,
              const std::vector<std::string>& tool = {}) {
  Comparison comparison;
  comparison.scene.name = "full";
  comparison.scene.arm = arm;
  Run run{Join::dmp3, Recording({"a", "b"}, Eigen::Vector2d(1.0, 1.0), 2, tool), {}, {}, 0.0};
  run.metrics.torque_jump_nm = jump;
  run.metrics.tracking_max_rad = 0.02;
  run.metrics.tracking_after_join_max_rad = 0.002;
  run.metrics.tool_tracking_max_m = 0.0123;
  run.metrics.tool_tracking_after_join_max_m = 1e-4;
  if (tool.size() > 3) run.metrics.tool_tracking_max_rad = 0.00999;
  run.recording.outcomes = {{"wave_peak_m", 0.01},
                            {"spilled_share", spilled},
                            {"stopped_share", stopped},
                            {"limited_share", limited}};
  comparison.runs.push_back(std::move(run));
  return comparison;
}

TEST(Overview, HasBothArmsInOneRow) {
  const std::string text =
      overview({on("ideal", 0.5, 0.0, 0.0, 0.0), on("published", 1.5, 0.25, 0.0, 0.031)});
  EXPECT_THAT(text, AllOf(HasSubstr("| full  | dmp3   | spilled 0 % / 25 % |         0.5 / 1.5 |"),
                          HasSubstr("2.0 mrad |"), HasSubstr("20 mrad |"), HasSubstr(" 3.1 |"),
                          HasSubstr("on the ideal arm / on the published arm")));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
}

TEST(Overview, SaysOnWhichArmTheRunStopped) {
  EXPECT_THAT(overview({on("ideal", 1.0, 0.0, 0.0, 0.0), on("published", 1.0, 0.0, 1.0, 0.0)}),
              HasSubstr("| spilled 0 %, stopped 0 % / 100 % |"));
  EXPECT_THAT(overview({on("ideal", 1.0, 0.0, 1.0, 0.0), on("published", 1.0, 0.0, 1.0, 0.0)}),
              HasSubstr("| spilled 0 %, stopped 100 % |"));
}

TEST(Overview, HasOneFigureWhereThereIsOneArm) {
  const std::string text = overview({on("ideal", 0.5, 0.0, 0.0, 0.0)});
  EXPECT_THAT(text, AllOf(HasSubstr("|               0.5 |"), Not(HasSubstr(" / b"))));
}

TEST(Overview, TellsWhatCameOfASceneInUnitsForPeople) {
  Comparison caught = on("ideal", 0.5, 0.0, 0.0, 0.0);
  caught.runs[0].recording.outcomes = {{"miss_m", 0.00224},
                                       {"velocity_miss_m_s", 0.0087},
                                       {"time_miss_s", 0.00234},
                                       {"clearance_m", -0.06, true},
                                       {"obstacle_distance_m", NAN, true},
                                       {"wave_peak_m", 0.01},
                                       {"ringing_nm", 3.0},
                                       {"stopped_share", 0.0},
                                       {"limited_share", 0.1}};
  EXPECT_THAT(overview({caught}),
              HasSubstr("| miss 2.2 mm, velocity miss 8.7 mm/s, time miss 2.3 ms, "
                        "clearance -60.0 mm, obstacle distance n/a |"));
  const std::string text = table(caught);
  for (const char* heading : {"| miss [m] ", "| velocity miss [m/s] ", "| time miss [s] ",
                              "| clearance [m] ", "| wave peak [m] ", "| ringing [N·m] "})
    EXPECT_THAT(text, HasSubstr(heading));
}

TEST(Overview, TellsTrackingInTheUnitsOfWhatIsMissed) {
  EXPECT_THAT(overview({on("soft", 1.0, 0.0, 0.0, 0.0, {"x", "y", "z"})}),
              AllOf(HasSubstr(" 0.10 mm |"), HasSubstr(" 12 mm |")));
  EXPECT_THAT(overview({on("soft", 1.0, 0.0, 0.0, 0.0, {"x", "y", "z", "rx", "ry", "rz"})}),
              HasSubstr("| 12 mm, 10 mrad |"));
  Comparison sliding = on("soft", 1.0, 0.0, 0.0, 0.0);
  sliding.runs[0].recording.slides = {true, true};
  EXPECT_THAT(overview({sliding}), HasSubstr(" 2.0 mm |"));
  sliding.runs[0].recording.slides = {true, false};
  EXPECT_THAT(overview({sliding}), HasSubstr(" 2.0 mrad or mm |"));
}

}  // namespace
}  // namespace seam
