#include <cstdio>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "tests/support.hpp"

namespace seam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int status;
  std::string output;  // and errors
};

Outcome run(const std::string& arguments) {
  FILE* pipe =
      popen((std::string(SEAM_PROGRAM) + " " + arguments + " 2>&1 </dev/null").c_str(), "r");
  Outcome outcome{-1, {}};
  char part[4096];
  for (std::size_t n = 0; (n = fread(part, 1, sizeof part, pipe)) > 0;)
    outcome.output.append(part, n);
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

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
              AllOf(HasSubstr("| dmp2 "), HasSubstr("| dmp2a "), HasSubstr("| dmp3 ")));
  ASSERT_EQ(run("bench line --jobs 1 --out " + folder.path("b")).status, 0);
  const auto files = files_below(folder.path("a"));
  EXPECT_THAT(files, testing::IsSupersetOf({"summary.json", "line/dmp2.csv", "line/dmp2a.csv",
                                            "line/dmp3.csv", "line/line.png", "line/torque.png"}));
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

TEST(Program, HelpsWithExitCodeZero) {
  for (const char* arguments : {"--help", "bench --help", "run --help", "--version"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_FALSE(outcome.output.empty()) << arguments;
  }
}

struct BadCall {
  const char* name;
  const char* arguments;
  const char* message;
};

class ProgramRefuses : public testing::TestWithParam<BadCall> {};

TEST_P(ProgramRefuses, WithOneLineAndExitCodeTwo) {
  const Outcome outcome = run(GetParam().arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.output, AllOf(StartsWith("seam: "), HasSubstr(GetParam().message)));
  EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(
    , ProgramRefuses,
    testing::Values(
        BadCall{"NoCommand", "", "subcommand"},
        BadCall{"UnknownCommand", "dance", "subcommand is required"},
        BadCall{"UnknownScene", "run nowhere --method dmp2", "nowhere.yaml: cannot be read"},
        BadCall{"UnknownMethod", "run line --method dmp9", "must be one of dmp2, dmp2a, dmp3"},
        BadCall{"NoMethod", "run line", "--method is required"},
        BadCall{"NegativeTick", "bench line --dt -1", "--dt"},
        BadCall{"NoJobs", "bench line --jobs 0", "--jobs"},
        BadCall{"UnwritableFolder", "bench line --out /proc/seam", "/proc/seam"}),
    [](const auto& bad) { return bad.param.name; });

}  // namespace
}  // namespace seam
