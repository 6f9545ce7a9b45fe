#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "tests/refusals.hpp"

namespace seam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using test::BadCall;
using test::Outcome;
using test::run;

std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(std::filesystem::relative(entry.path(), folder));
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Program, BenchComparesAndLeavesTheSameBytesTwice) {
  const TempFolder folder;
  const Outcome first = run("bench line --out " + folder.path("a"));
  ASSERT_EQ(first.status, 0) << first.output;
  EXPECT_THAT(first.output,
              AllOf(HasSubstr("   dmp2 |"), HasSubstr("  dmp2a |"), HasSubstr("   dmp3 |")));
  ASSERT_EQ(run("bench line --jobs 1 --out " + folder.path("b")).status, 0);
  const auto files = files_below(folder.path("a"));
  EXPECT_THAT(files, testing::IsSupersetOf(
                         {"summary.json", "line/dmp2.csv", "line/dmp2a.csv", "line/dmp3.csv",
                          "line/dmp3.replay.json", "line/line.png", "line/torque.png",
                          "report.html", "line-published/dmp3.csv", "line-published/torque.png"}));
  EXPECT_EQ(files, files_below(folder.path("b")));
  for (const std::string& file : files)
    EXPECT_TRUE(test::read_file(folder.path("a/" + file)) ==
                test::read_file(folder.path("b/" + file)))
        << file;
}

TEST(Program, SummaryHoldsTheFiguresOfEveryRunAndJoin) {
  const TempFolder folder;
  ASSERT_EQ(run("run line --method dmp3 --dt 0.002 --out " + folder.path("r")).status, 0);
  const auto summary = nlohmann::json::parse(test::read_file(folder.path("r/summary.json")));
  EXPECT_EQ(summary["format"], 1);
  ASSERT_EQ(summary["runs"].size(), 1U);
  const auto& only = summary["runs"][0];
  EXPECT_EQ(only["scene"], "line");
  EXPECT_EQ(only["method"], "dmp3");
  EXPECT_EQ(only["arm"], "ideal");
  EXPECT_EQ(only["dt"], 0.002);
  ASSERT_EQ(only["joins"].size(), 2U);
  EXPECT_EQ(only["joins"][0]["time"], 0.25);
  EXPECT_EQ(only["joins"][1]["time"], 1.25);
  EXPECT_GT(only["joins"][1]["metrics"]["torque_jump_order"], 0.9);
  for (const char* metric :
       {"torque_jump_nm", "torque_jump_percent", "torque_jump_order", "acceleration_jump_rad_s2",
        "torque_rate_peak_nm_s", "jerk_peak_rad_s3", "tracking_rms_rad", "tracking_max_rad",
        "deviation_peak_rad"})
    EXPECT_TRUE(only["metrics"][metric].is_number()) << metric;
}

TEST(Program, PlaysOnTheArmThatIsAskedFor) {
  const TempFolder folder;
  int calls = 0;
  const auto runs = [&](const std::string& arguments) {
    const std::string out = folder.path("r" + std::to_string(++calls));
    const Outcome outcome = run(arguments + " --method dmp3 --dt 0.004 --out " + out);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const auto summary = nlohmann::json::parse(test::read_file(out + "/summary.json"));
    std::vector<std::string> arms;
    for (const auto& run : summary["runs"]) arms.push_back(run["arm"]);
    return arms;
  };
  using Arms = std::vector<std::string>;
  EXPECT_EQ(runs("bench line"), (Arms{"ideal", "published"}));
  EXPECT_EQ(runs("bench line --arm published"), Arms{"published"});
  EXPECT_EQ(runs("run line --arm published"), Arms{"published"});
  EXPECT_EQ(runs("run line --set arm=published"), Arms{"published"});
  EXPECT_EQ(runs("run line --set arm=published --arm ideal"), Arms{"ideal"});
  const std::string own = test::scene_text("line");
  folder.write("soft.yaml", "format: seam-arm 1\nfriction: {viscous: 1}\n");
  const std::string scene = folder.write("own.yaml", own + "\narm: ./soft.yaml\n");
  EXPECT_EQ(runs("bench " + scene), (Arms{"ideal", "soft"}));
  EXPECT_EQ(runs("run " + scene), Arms{"soft"});
}

TEST(Program, SaysWhereThereIsNoPublishedArm) {
  const TempFolder folder;
  const std::string scene = folder.write(
      "other.yaml",
      test::replaced(test::scene_text("line"), SEAM_ASSETS "/pa10/pa10.urdf",
                     folder.write("pa10.urdf", test::read_file(SEAM_ASSETS "/pa10/pa10.urdf"))));
  const std::string bench =
      "bench " + scene + " --method dmp3 --dt 0.004 --out " + folder.path("r");
  const std::string path = folder.path("published.yaml");
  const std::string meshes = "ROS_PACKAGE_PATH=" SEAM_ASSETS;
  const Outcome both = run(bench, meshes);
  EXPECT_EQ(both.status, 0) << both.output;
  EXPECT_THAT(both.output, HasSubstr("other: on the ideal arm only, there is no " + path + "\n"));
  const Outcome published = run(bench + " --arm published", meshes);
  EXPECT_EQ(published.status, 2);
  EXPECT_EQ(published.output,
            "seam: " + scene + ": key \"arm\": \"published\", there is no " + path + "\n");
}

TEST(Program, DrawsScenesWithAnyTitleIntoAnyFolder) {
  const TempFolder folder;
  std::string scene = test::scene_text("line");
  const std::string title = "title: ";
  scene.insert(scene.find(title) + title.size(), "The arm's $1 \\\"ramps\\\" of_joint ");
  const std::string path = folder.write("odd name.yaml", scene);
  const std::string out = folder.path("it's here");
  const Outcome outcome = run("run '" + path + "' --method dmp2 --out \"" + out + "\"");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_GT(std::filesystem::file_size(out + "/odd name/odd name.png"), 10000U);
}

TEST(Program, SaysSoBeforeItPlaysWhereThereIsNoGnuplot) {
  const TempFolder folder;
  const std::string out = folder.path("r");
  const Outcome outcome = run("run line --method dmp2 --out " + out, "PATH=/nowhere ");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.output,
            "seam: gnuplot: cannot be run, it is needed for the pictures (Debian: gnuplot-nox)\n");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Program, LeavesNoPictureWhereGnuplotLeavesHalfOfOne) {
  const TempFolder folder;
  const std::string gnuplot =
      folder.write("gnuplot", "#!/bin/sh\n[ $1 = --version ] || printf PNG > $3\n");
  std::filesystem::permissions(gnuplot, std::filesystem::perms::owner_all);
  const Outcome outcome =
      run("run line --method dmp2 --out " + folder.path("r"), "PATH=" + folder.path("") + ":$PATH");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.output, HasSubstr("line.png: gnuplot cannot draw it"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("r/line/line.png")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("r/line/line.png.part")));
}

// The table in the README is what the bench leaves, but for pouring, whose grains follow the last bit of a machine's
// mathematical library; and every figure is as in the committed baselines.
TEST(Program, PrintsTheTableOfTheReadmeAndKeepsTheBaselines) {
  const auto rows = [](const std::string& text) {
    std::vector<std::string> table;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("| ", 0) == 0 && line.find("pouring") == std::string::npos) {
        line.erase(std::remove(line.begin(), line.end(), ' '), line.end());
        table.push_back(line);
      }
    return table;
  };
  const TempFolder folder;
  const std::string readme = test::read_file(std::string(SEAM_README));
  const auto begin = readme.find("<!-- table -->");
  const Outcome outcome = run("bench carrying catching line obstacle through wiping --out " +
                              folder.path("r") + " --check " SEAM_BASELINES);
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const auto left = rows(test::read_file(folder.path("r/overview.md")));
  ASSERT_EQ(left.size(), 25U);
  EXPECT_LT(std::filesystem::file_size(folder.path("r/report.html")), 7'000'000U);
  EXPECT_EQ(left, rows(readme.substr(begin, readme.find("<!-- /table -->") - begin)));
}

TEST(Program, KeepsTheBaselinesOfPouringAndFillsTheGlassAtAllPlaces) {
  const TempFolder folder;
  const Outcome outcome =
      run("bench pouring --out " + folder.path("r") + " --check " SEAM_BASELINES);
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const auto summary = nlohmann::json::parse(test::read_file(folder.path("r/summary.json")));
  ASSERT_EQ(summary["runs"].size(), 8U);
  for (const auto& run : summary["runs"])  // the least of all places
    EXPECT_GE(std::stod(run["outcomes"]["poured"].get<std::string>()), 95) << run["method"];
}

// As a user sees the gate: a reference that the integrator does not match tracks worse, and so does an arm whose friction is
// not observed.
TEST(Program, FailsACheckWithExitCodeOneUntilTheBaselinesAreRenewed) {
  const TempFolder folder;
  for (const char* file : {"tolerances.yaml", "line.json", "line-published.json"})
    folder.write(file, test::read_file(std::string(SEAM_BASELINES "/") + file));
  const std::string bench =
      "bench line --set control.reference=plain --set control.observer=0 --out " +
      folder.path("r") + " --check " + folder.path("");
  const Outcome worse = run(bench);
  EXPECT_EQ(worse.status, 1);
  EXPECT_THAT(worse.output, AllOf(HasSubstr("line dmp3: tracking_max_rad"),
                                  HasSubstr("line-published dmp3: tracking_after_join_max_rad"),
                                  HasSubstr("worse by")));
  EXPECT_EQ(run(bench + " --update").status, 0);
  EXPECT_EQ(run(bench).status, 0);
}

TEST(Program, HelpsWithExitCodeZero) {
  for (const char* arguments : {"--help", "bench --help", "run --help", "--version"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_FALSE(outcome.output.empty()) << arguments;
  }
}

TEST(Program, ReadsFilesBesideASceneWhereTheirFolderIsAllowed) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path("demos"));
  std::filesystem::copy(SEAM_ASSETS "/demos/ramp_up.csv", folder.path("demos/up.csv"));
  const std::string scene = folder.write(
      "mine/my.yaml", test::replaced(test::scene_text("line"), SEAM_ASSETS "/demos/ramp_up.csv",
                                     "../demos/up.csv"));
  const std::string task = folder.write("mine/task.yaml",
                                        "format: seam-sequence 1\nprimitives: {a: {demonstration: "
                                        "../demos/up.csv}}\nsteps: [{play: a}]\n");
  const std::string calls[] = {
      "bench --list " + scene, "rollout " + task + " --method dmp3 -o " + folder.path("a.csv"),
      "sweep " + scene + " --method dmp2 --vary dt=0.01 --out " + folder.path("b.csv")};
  for (const std::string& call : calls) {
    const Outcome outcome = run(call);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(
        outcome.output,
        HasSubstr("\"../demos/up.csv\" leads out of the file's folder, must be in it or below, "
                  "or in a folder that is allowed (seam --allow DIR)\n"));
    EXPECT_EQ(run(call + " --allow " + folder.path("demos")).status, 0) << call;
  }
}

TEST(Program, RunLeavesAloneWhatABenchHasCompared) {
  const TempFolder folder;
  const std::string out = " --out " + folder.path("r");
  ASSERT_EQ(run("bench line --method dmp2,dmp3" + out).status, 0);
  const std::string summary = test::read_file(folder.path("r/summary.json"));
  const Outcome outcome = run("run line --method dmp3" + out);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.output,
            "seam: " + folder.path("r") +
                ": holds what seam bench has compared, needs another folder (--out)\n");
  EXPECT_EQ(test::read_file(folder.path("r/summary.json")), summary);
  const std::string alone = "run line --method dmp3 --out " + folder.path("one");
  EXPECT_EQ(run(alone).status, 0);
  EXPECT_EQ(run(alone).status, 0);  // a run takes the place of another
}

TEST(Program, FillsAFolderAlone) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path("r"));
  const int other =
      open(folder.path("r").c_str(), O_RDONLY | O_DIRECTORY);  // as another process has it
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  for (const char* command : {"bench line", "run line --method dmp3", "experiment speed"}) {
    const Outcome outcome = run(command + (" --out " + folder.path("r")));
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_EQ(outcome.output,
              "seam: " + folder.path("r") +
                  ": is being filled by another seam, needs another folder (--out)\n");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("r")));
  close(other);
  EXPECT_EQ(run("run line --method dmp3 --out " + folder.path("r")).status, 0);
}

class ProgramRefuses : public testing::TestWithParam<BadCall> {};

TEST_P(ProgramRefuses, WithOneLineAndExitCodeTwo) {
  test::expect_refused(GetParam(), TempFolder());
}

INSTANTIATE_TEST_SUITE_P(
    , ProgramRefuses,
    testing::Values(
        BadCall{"NoCommand", "", "subcommand"},
        BadCall{"UnknownCommand", "dance", "subcommand is required"},
        BadCall{"UnknownScene", "run nowhere --method dmp2", "nowhere.yaml: cannot be read"},
        BadCall{"UnknownMethod", "run line --method dmp9", "must be one of dmp2, dmp2a, dmp3"},
        BadCall{"MethodTwice", "bench line --method dmp3,dmp3", "method \"dmp3\": given twice"},
        BadCall{"NoMethod", "run line", "line: has no key \"method\", needs --method"},
        BadCall{"BothArmsOfARun", "run line --method dmp3 --arm both", "--arm: \"both\", seam run"},
        BadCall{"UnknownArm", "bench line --arm new", "there is no "},
        BadCall{"NoArm", "bench line --arm ''", "line.yaml: key \"arm\""},
        BadCall{"NegativeTick", "bench line --dt -1", "--dt"},
        BadCall{"NoJobs", "bench line --jobs 0", "--jobs"},
        BadCall{"TickThatIsNotANumber", "bench line --dt nan",
                "--dt: nan, must be a finite number"},
        BadCall{"SetNothing", "bench line --set dt", "dt: must be key=value"},
        BadCall{"SetUnknown", "run line --method dmp2 --set dz=1", "key \"dz\": not known here"},
        BadCall{"NoBaselines", "bench line --check @", "tolerances.yaml: cannot be read"},
        BadCall{"RenewsNothing", "bench line --update", "--update: needs --check"},
        BadCall{"NoFolder", "bench line --out ''", "--out: is empty"},
        BadCall{"SceneTwice", "bench line line", "scene \"line\": given twice"},
        BadCall{"UnwritableFolder", "bench line --out /proc/seam", "/proc/seam"},
        BadCall{"ReportOfNothing", "report @nowhere -o @page.html",
                "nowhere/summary.json: cannot be read, must be what seam bench left"},
        BadCall{"ReportNowhere", "report @nowhere", "--out"}),
    test::by_name);

}  // namespace
}  // namespace seam
