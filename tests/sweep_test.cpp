// Sweeps: what is varied, the file that fills, and the program that is killed in the middle.

#include <csignal>
#include <cstdlib>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/sweep_file.hpp"
#include "tests/refusals.hpp"

namespace seam {
namespace {

using test::BadCall;
using test::Outcome;
using test::read_file;
using test::refusal;
using test::run;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> grid(const std::string& text) {
  const Variation variation = Variation::read(text);
  std::vector<std::string> values;
  for (std::int64_t i = 0; i < variation.count; ++i) values.push_back(variation.value(i));
  return values;
}

TEST(Variation, ReadsGridsAndLists) {
  EXPECT_THAT(grid("speed=0.5:2:4"), ElementsAre("0.5", "1", "1.5", "2"));
  EXPECT_THAT(grid("seed=1:3:3"), ElementsAre("1", "2", "3"));
  EXPECT_THAT(grid("x=0.1:-0.3:2"), ElementsAre("0.1", "-0.3"));
  EXPECT_THAT(grid("x=7:9:1"), ElementsAre("7"));
  EXPECT_THAT(grid("a.b=ideal,{lag: 0.1, effort_limit: yes},'x,y'"),
              ElementsAre("ideal", "{lag: 0.1, effort_limit: yes}", "'x,y'"));
  EXPECT_EQ(grid("x=0:0.7:1000").back(), "0.7");
}

TEST(Variation, DrawsFromItsInterval) {
  const Variation variation = Variation::read("speed=0.5:2");
  ASSERT_TRUE(variation.drawn());
  for (std::int64_t draw = 0; draw < 1000; ++draw) {
    const double value = std::stod(variation.value(3, draw));
    EXPECT_GE(value, 0.5);
    EXPECT_LT(value, 2.0);
    EXPECT_EQ(value, 0.5 + 1.5 * chance(3, "speed", draw));
  }
}

// The figures are those of a second implementation, in Python.
TEST(Chance, IsTheSameOnEveryMachine) {
  EXPECT_EQ(chance(1, "speed", 0), 0x1.0849ec863d401p-1);
  EXPECT_EQ(chance(1, "speed", 1), 0x1.82e8d76b4db7cp-3);
  EXPECT_EQ(chance(2, "speed", 0), 0x1.009f9d3a767d3p-1);
  EXPECT_EQ(chance(1, "events.0.at", 123456789), 0x1.9e4091f8715b2p-2);
}

// Bounds that a fair generator passes all but once in a million.
TEST(Chance, IsEvenAndKnowsNoOtherKeyOrDrawOrSeed) {
  constexpr int N = 100000;
  constexpr int bins = 100;
  std::vector<int> counts(bins);
  double of_keys = 0.0, of_draws = 0.0, of_seeds = 0.0;
  for (int i = 0; i < N; ++i) {
    const double u = chance(7, "speed", i);
    ++counts[static_cast<std::size_t>(u * bins)];
    of_keys += (u - 0.5) * (chance(7, "dt", i) - 0.5);
    of_draws += (u - 0.5) * (chance(7, "speed", i + 1) - 0.5);
    of_seeds += (u - 0.5) * (chance(8, "speed", i) - 0.5);
  }
  double chi2 = 0.0;  // 99 degrees of freedom: 99 ± 14
  for (const int count : counts) chi2 += std::pow(count - N / bins, 2) / (N / bins);
  EXPECT_LT(chi2, 99.0 + 5.5 * 14.07);
  EXPECT_GT(chi2, 99.0 - 5.0 * 14.07);
  for (const double sum : {of_keys, of_draws, of_seeds})
    EXPECT_LT(std::abs(sum) * 12.0 / std::sqrt(N), 5.0);
}

SweepPlan plan_of(const std::vector<std::string>& vary, std::int64_t draws = 1) {
  SweepPlan plan;
  for (const std::string& text : vary) plan.variations.push_back(Variation::read(text));
  plan.draws = draws;
  plan.methods = {Join::dmp2, Join::dmp3};
  return plan;
}

TEST(SweepPlan, CombinesAllGridsForEachDraw) {
  const SweepPlan plan = plan_of({"a=1,2", "b=0:1", "c=x,y,z"}, 2);
  ASSERT_EQ(plan.samples(), 12);
  const std::string first = Variation::read("b=0:1").value(1, 0);
  const std::string second = Variation::read("b=0:1").value(1, 1);
  EXPECT_THAT(plan.values(0), ElementsAre("1", first, "x"));
  EXPECT_THAT(plan.values(1), ElementsAre("1", first, "y"));
  EXPECT_THAT(plan.values(3), ElementsAre("2", first, "x"));
  EXPECT_THAT(plan.values(11), ElementsAre("2", second, "z"));
  const SweepPlan more = plan_of({"a=1,2", "b=0:1", "c=x,y,z"}, 200);
  for (std::int64_t i = 0; i < plan.samples(); ++i) EXPECT_EQ(plan.values(i), more.values(i));
}

TEST(Shard, PartsASweepSoThatEverySampleIsInOne) {
  for (const std::int64_t samples : {0, 1, 5, 12, 13})
    for (const std::int64_t n : {1, 2, 3, 7}) {
      std::multiset<std::int64_t> all;
      for (std::int64_t i = 0; i < n; ++i) {
        const Shard shard = Shard::read(std::to_string(i) + "/" + std::to_string(n));
        for (std::int64_t k = 0; k < shard.size(samples); ++k) {
          all.insert(shard.sample(k));
          EXPECT_TRUE(shard.holds(shard.sample(k)));
        }
      }
      ASSERT_EQ(all.size(), static_cast<std::size_t>(samples));
      for (std::int64_t i = 0; i < samples; ++i) EXPECT_EQ(all.count(i), 1U);
    }
}

// A file without a scene: what is in the rows does not matter to it.
class SweepFileOf : public testing::Test {
 protected:
  static SweepContents contents(std::int64_t draws = 4, const Shard& shard = {}) {
    SweepContents contents;
    contents.subject = {{"scene", "none"}};
    contents.plan = plan_of({"a=0:1", "b={c: 1},2"}, draws);
    contents.metrics = {"m_one", "m_two"};
    contents.shard = shard;
    return contents;
  }
  static std::string rows(const SweepContents& contents, std::int64_t sample) {
    std::string rows;
    for (const Join method : contents.plan.methods)
      rows += contents.row_begin(sample, method) + std::to_string(sample * 1000) + ",,ok\n";
    return rows;
  }
  // Fills what is missing, from the last to the first.
  static void fill(const std::string& path, const SweepContents& contents) {
    SweepFile file(path, contents);
    for (std::int64_t k = contents.size(); k-- > 0;) {
      const std::int64_t sample = contents.shard.sample(k);
      if (!file.has(sample)) file.append(sample, rows(contents, sample));
    }
    file.finish();
  }
  std::string path(const std::string& name) const { return folder_.path(name); }

  TempFolder folder_;
};

TEST_F(SweepFileOf, IsInOrderWhateverTheOrderInWhichItWasFilled) {
  const SweepContents all = contents();
  fill(path("a.csv"), all);
  std::string expected = "index,method,a,b,m_one,m_two,status\n";
  for (std::int64_t i = 0; i < 8; ++i) expected += rows(all, i);
  EXPECT_EQ(read_file(path("a.csv")), expected);
  EXPECT_FALSE(std::filesystem::exists(path("a.csv.rows")));
}

TEST_F(SweepFileOf, IsTakenUpAgainWhereverItBrokeOff) {
  const SweepContents all = contents();
  fill(path("whole.csv"), all);
  const std::string whole = read_file(path("whole.csv"));
  const std::string begin = all.header() + rows(all, 5) + rows(all, 2);
  for (std::size_t length = 0; length <= begin.size(); ++length) {
    const std::string name = "cut" + std::to_string(length) + ".csv";
    folder_.write(name + ".json", read_file(path("whole.csv.json")));
    folder_.write(name + ".rows", begin.substr(0, length));
    const auto size = [&](std::int64_t i) { return rows(all, i).size(); };
    const std::size_t first = all.header().size() + size(5);
    {
      const SweepFile file(path(name), all);
      EXPECT_EQ(file.done(), length == begin.size() ? 2 : length >= first ? 1 : 0) << length;
    }
    fill(path(name), all);
    ASSERT_EQ(read_file(path(name)), whole) << length;
  }
}

TEST_F(SweepFileOf, TakesMoreDraws) {
  fill(path("more.csv"), contents(2));
  EXPECT_EQ(SweepFile(path("more.csv"), contents(4)).done(), 4);
  fill(path("more.csv"), contents(4));
  fill(path("all.csv"), contents(4));
  EXPECT_EQ(read_file(path("more.csv")), read_file(path("all.csv")));
  EXPECT_EQ(read_file(path("more.csv.json")), read_file(path("all.csv.json")));
  EXPECT_THAT(refusal([&] { SweepFile(path("more.csv"), contents(3)); }),
              HasSubstr("more.csv: holds another sweep: samples were 4, are 3"));
}

TEST_F(SweepFileOf, RefusesWhatIsNotOfItsSweep) {
  const std::string file = path("a.csv");
  fill(file, contents());
  const std::string before = read_file(file);
  const auto said = [&](const std::function<void(SweepContents&)>& change) {
    SweepContents other = contents();
    change(other);
    return refusal([&] { SweepFile(file, other); });
  };
  EXPECT_THAT(said([](auto& c) { c.plan.seed = 2; }), HasSubstr("seed was 1, is 2"));
  EXPECT_THAT(said([](auto& c) { c.plan.methods.pop_back(); }), HasSubstr("methods was"));
  EXPECT_THAT(said([](auto& c) { c.plan.variations.pop_back(); }), HasSubstr("vary was"));
  EXPECT_THAT(said([](auto& c) { c.subject["scene"] = "line"; }), HasSubstr("scene was"));
  EXPECT_THAT(said([](auto& c) { c.shard = Shard{1, 2}; }), HasSubstr("shard was 0/1, is 1/2"));
  EXPECT_EQ(read_file(file), before);

  folder_.write("foreign.csv", "time,x\n0,1\n");
  EXPECT_THAT(refusal([&] { SweepFile(path("foreign.csv"), contents()); }),
              HasSubstr("foreign.csv: is there, but not"));
  EXPECT_EQ(read_file(path("foreign.csv")), "time,x\n0,1\n");
  folder_.write("a.csv.json", "{");
  EXPECT_THAT(refusal([&] { SweepFile(file, contents()); }), HasSubstr("does not describe"));
}

TEST_F(SweepFileOf, RefusesRowsThatSomebodyChanged) {
  const SweepContents all = contents();
  fill(path("a.csv"), all);
  std::filesystem::remove(path("a.csv"));
  const auto said = [&](const std::string& text) {
    folder_.write("a.csv.rows", text);
    return refusal([&] { SweepFile(path("a.csv"), all); });
  };
  EXPECT_THAT(said("time,x\n" + rows(all, 0)), HasSubstr("a.csv.rows:1: is not the header"));
  for (const char* row : {"9,dmp2,", "-1,dmp2,", "x,dmp2,", "0,dmp3,", "0,dmp2,0.3,"})
    EXPECT_THAT(said(all.header() + rows(all, 3) + row + rows(all, 0)),
                HasSubstr("a.csv.rows:4: is not a row of this sweep"));
}

TEST_F(SweepFileOf, IsFilledByOneProcessAtATime) {
  const SweepFile first(path("a.csv"), contents());
  EXPECT_THAT(refusal([&] { SweepFile(path("a.csv"), contents()); }),
              HasSubstr("a.csv: is being filled by another seam sweep"));
}

class Merge : public SweepFileOf {
 protected:
  std::vector<std::string> parts(std::int64_t n) const {
    std::vector<std::string> paths;
    for (std::int64_t i = 0; i < n; ++i) {
      paths.push_back(path("part" + std::to_string(i) + "of" + std::to_string(n)));
      fill(paths.back(), contents(4, {i, n}));
    }
    return paths;
  }
  std::string said(const std::vector<std::string>& paths) const {
    return refusal([&] { merge_sweeps(paths, path("out.csv")); });
  }
};

TEST_F(Merge, GivesTheBytesOfTheWhole) {
  fill(path("whole.csv"), contents());
  for (const std::int64_t n : {1, 2, 3, 8, 11}) {
    std::vector<std::string> paths = parts(n);
    std::reverse(paths.begin(), paths.end());
    merge_sweeps(paths, path("out.csv"));
    EXPECT_EQ(read_file(path("out.csv")), read_file(path("whole.csv"))) << n;
    EXPECT_EQ(read_file(path("out.csv.json")), read_file(path("whole.csv.json"))) << n;
  }
}

TEST_F(Merge, RefusesWhatIsMissingTwiceOrOfAnotherSweep) {
  const std::vector<std::string> paths = parts(3);
  EXPECT_THAT(said({paths[0], paths[2]}), HasSubstr("out.csv: sample 1 is in no part"));
  EXPECT_THAT(said({paths[0], paths[1], paths[0]}), HasSubstr("sample 0 is in another part, too"));
  EXPECT_THAT(said({paths[0], path("nothing")}), HasSubstr("nothing.json: cannot be read"));
  SweepContents other = contents(4, {1, 3});
  other.plan.seed = 2;
  fill(path("other"), other);
  EXPECT_THAT(said({paths[0], path("other"), paths[2]}),
              HasSubstr("other: is of another sweep than"));
  folder_.write("part1of3", read_file(paths[1]).substr(0, 100));
  EXPECT_THAT(said(paths), HasSubstr("part1of3: ends within a sample"));
  std::filesystem::remove(paths[1]);
  EXPECT_THAT(said(paths), HasSubstr("part1of3: is not there"));
  EXPECT_FALSE(std::filesystem::exists(path("out.csv")));
}

// The program, on a short scene with long ticks. Two of the six samples start beyond the elbow's limit of 2.39 rad.
class SweepProgram : public testing::Test {
 protected:
  SweepProgram() { folder_.write("line.yaml", test::scene_text("line")); }
  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string call(const std::string& out, const std::string& more = "") const {
    return "sweep " + path("line.yaml") +
           " --vary robot.start.E1=0.8,1.2,3 --vary sequence.steps.0.until.before_end=0:0.5"
           " --samples 2 --seed 4 --set dt=0.004 --set settle=0.1 --out " +
           path(out) + " " + more;
  }

  TempFolder folder_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(SweepProgram, LeavesTheSameBytesWhateverTheJobsAndShards) {
  ASSERT_EQ(run(call("one.csv", "--jobs 1")).status, 0);
  const std::string one = read_file(path("one.csv"));
  EXPECT_EQ(lines_of(one).size(), 1U + 6U * 4U);
  for (const char* jobs : {"2", "5"}) {
    ASSERT_EQ(run(call("other.csv", std::string("--jobs ") + jobs)).status, 0);
    EXPECT_EQ(read_file(path("other.csv")), one);
    std::filesystem::remove(path("other.csv"));
  }
  std::string parts;
  for (const char* i : {"0", "1", "2", "3"}) {
    const std::string part = std::string("part") + i + ".csv";
    ASSERT_EQ(run(call(part, std::string("--shard ") + i + "/4")).status, 0);
    parts += " " + path(part);
  }
  const Outcome merged = run("sweep --merge" + parts + " --out " + path("merged.csv"));
  EXPECT_EQ(merged.status, 0) << merged.output;
  EXPECT_THAT(merged.output, HasSubstr("merged.csv: 6 samples, each with 4 methods, of 4 parts"));
  EXPECT_EQ(read_file(path("merged.csv")), one);
  EXPECT_EQ(read_file(path("merged.csv.json")), read_file(path("one.csv.json")));
}

TEST_F(SweepProgram, MeasuresWhatSeamRunMeasuresAndKeepsRefusalsAsResults) {
  EXPECT_EQ(
      run(call("a.csv", "--method dmp2a,dmp3")).output,
      path("a.csv") +
          ": 6 samples, each with 2 methods; 2 were refused by the scene, their status says why\n");
  const auto lines = lines_of(read_file(path("a.csv")));
  const auto fields = [](std::string line) {
    std::istringstream stream(line);
    std::vector<std::string> list;
    for (std::string field; std::getline(stream, field, ',');) list.push_back(field);
    return list;
  };
  const auto names = fields(lines[0]);
  const auto row = fields(lines[10]);  // of sample 4
  EXPECT_EQ(row[0] + row[1] + row[2] + row.back(), "4dmp31.2ok");
  ASSERT_EQ(run("run " + path("line.yaml") + " --method dmp3 --set dt=0.004 --set settle=0.1" +
                " --set robot.start.E1=" + row[2] +
                " --set sequence.steps.0.until.before_end=" + row[3] + " --out " + path("r"))
                .status,
            0);
  const auto metrics =
      nlohmann::json::parse(read_file(path("r/summary.json")))["runs"][0]["metrics"];
  ASSERT_EQ(metrics.size() + 5, names.size());
  for (std::size_t c = 4; c + 1 < names.size(); ++c) {
    const auto& expected = metrics.at(names[c]);
    if (expected.is_null())
      EXPECT_EQ(row[c], "") << names[c];
    else
      EXPECT_EQ(std::stod(row[c]), expected.get<double>()) << names[c];
  }
  const std::string nothing(metrics.size(), ',');
  EXPECT_THAT(lines[5], AllOf(StartsWith("2,dmp2a,3,"), HasSubstr("," + nothing + "\"line.yaml:"),
                              HasSubstr("\"\"E1\"\": 3, must be in -2.39")));
}

// Starts the sweep as a process of its own.
pid_t start(const std::string& arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  const std::string command = std::string("exec ") + SEAM_PROGRAM + " " + arguments + " >/dev/null";
  execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  _exit(127);
}

TEST_F(SweepProgram, IsKilledAgainAndAgainAndLosesNothing) {
  const std::string grid = " --vary speed=0.9:1.1:4";
  ASSERT_EQ(run(call("whole.csv", grid)).status, 0);
  std::size_t kept = 0;
  int kills = 0;
  for (bool through = false; !through; ++kills) {
    ASSERT_LT(kills, 100);
    const pid_t child = start(call("killed.csv", grid));
    std::size_t rows = kept;
    int status = 0;
    do {  // until it has done something new, or is through
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      rows = std::max(rows, lines_of(read_file(path("killed.csv.rows"))).size());
      through = waitpid(child, &status, WNOHANG) == child;
    } while (!through && rows < kept + 6);
    if (through) break;
    kill(child, SIGKILL);
    ASSERT_EQ(waitpid(child, &status, 0), child);
    if (!WIFSIGNALED(status)) break;
    kept = lines_of(read_file(path("killed.csv.rows"))).size();
  }
  EXPECT_GT(kills, 3);
  const Outcome last = run(call("killed.csv", grid));
  ASSERT_EQ(last.status, 0) << last.output;
  EXPECT_THAT(last.output, HasSubstr("24 samples, each with 4 methods; 24 were there already"));
  EXPECT_EQ(read_file(path("killed.csv")), read_file(path("whole.csv")));
}

TEST_F(SweepProgram, TakesUpTheSamplesThatAreThereAndNoOthers) {
  ASSERT_EQ(run(call("whole.csv")).status, 0);
  const auto lines = lines_of(read_file(path("whole.csv")));
  std::string rows = lines[0] + "\n";
  for (std::size_t i = 9; i < 17; ++i) rows += lines[i] + "\n";  // samples 2 and 3
  folder_.write("a.csv.json", read_file(path("whole.csv.json")));
  folder_.write("a.csv.rows", rows + lines[1] + "\n" + lines[2].substr(0, 30));
  const Outcome resumed = run(call("a.csv"));
  EXPECT_THAT(resumed.output, HasSubstr("6 samples, each with 4 methods; 2 were there already"));
  EXPECT_EQ(read_file(path("a.csv")), read_file(path("whole.csv")));
}

TEST_F(SweepProgram, LosesNothingWhereTheDiskIsFull) {
  ASSERT_EQ(run(call("whole.csv")).status, 0);
  // A file may have 2048 or 4096 bytes, which ends within a sample.
  const Outcome full = run(call("a.csv"), "trap '' XFSZ; ulimit -f 4;");
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.output, AllOf(StartsWith("seam: " + path("a.csv") + ": cannot be written: "),
                                 HasSubstr("what is done is in")));
  EXPECT_EQ(lines_of(full.output).size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(path("a.csv")));
  const std::size_t kept = lines_of(read_file(path("a.csv.rows"))).size();
  EXPECT_EQ(kept % 4, 1U);  // the header and whole samples
  EXPECT_GT(kept, 1U);
  const Outcome resumed = run(call("a.csv"));
  EXPECT_EQ(resumed.status, 0);
  EXPECT_THAT(resumed.output, HasSubstr(std::to_string(kept / 4) + " were there already"));
  EXPECT_EQ(read_file(path("a.csv")), read_file(path("whole.csv")));
}

TEST_F(SweepProgram, RefusesAFileOfAnotherSweepOrScene) {
  ASSERT_EQ(run(call("a.csv", "--method dmp3")).status, 0);
  const auto said = [&](const std::string& more) {
    const Outcome outcome = run(call("a.csv", more));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(lines_of(outcome.output).size(), 1U);
    return outcome.output;
  };
  EXPECT_THAT(said(""), HasSubstr("a.csv: holds another sweep: methods was"));
  EXPECT_THAT(said("--method dmp3 --set speed=2"), HasSubstr("holds another sweep: set was"));
  EXPECT_THAT(said("--method dmp3 --vary speed=1,2"), HasSubstr("holds another sweep: vary was"));
  folder_.write("line.yaml", test::scene_text("line") + "\n# changed\n");
  EXPECT_THAT(said("--method dmp3"),
              HasSubstr("holds another sweep: line.yaml has changed; name another --out"));
}

class SweepRefuses : public testing::TestWithParam<BadCall> {};

TEST_P(SweepRefuses, WithOneLineAndExitCodeTwoAndNoFile) {
  const TempFolder folder;
  test::expect_refused(GetParam(), folder);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path(""))) << "something was written";
}

INSTANTIATE_TEST_SUITE_P(
    , SweepRefuses,
    testing::Values(
        BadCall{"NoOutput", "sweep line --vary speed=1,2", "--out is required"},
        BadCall{"NoScene", "sweep --vary speed=1,2 --out @a.csv", "needs a scene"},
        BadCall{"NothingVaried", "sweep line --out @a.csv", "--vary: is missing"},
        BadCall{"UnknownScene", "sweep nowhere --vary speed=1,2 --out @a.csv",
                "nowhere.yaml: cannot be read"},
        BadCall{"UnknownKey", "sweep line --vary speeed=1:2:3 --out @a.csv",
                "key \"speeed\": not known here"},
        BadCall{"UnknownJoint", "sweep line --vary robot.start.E9=1:2:3 --out @a.csv", "E9"},
        BadCall{"NoValues", "sweep line --vary speed=1:2:0 --out @a.csv", "0 values, must be >= 1"},
        BadCall{"HalfAValue", "sweep line --vary speed=1:2:1.5 --out @a.csv", "whole number"},
        BadCall{"NotANumber", "sweep line --vary speed=nan:2:3 --out @a.csv",
                "\"nan\", must be a finite number"},
        BadCall{"Infinite", "sweep line --vary speed=1:inf:3 --out @a.csv", "finite number"},
        BadCall{"NoEnd", "sweep line --vary speed=1: --samples 2 --out @a.csv", "finite number"},
        BadCall{"FourParts", "sweep line --vary speed=1:2:3:4 --out @a.csv", "must be key=a:b:n"},
        BadCall{"NoKey", "sweep line --vary =1:2:3 --out @a.csv", "must be key=a:b:n"},
        BadCall{"NoValue", "sweep line --vary speed= --out @a.csv", "must be key=a:b:n"},
        BadCall{"EmptyValue", "sweep line --vary speed=1,,2 --out @a.csv", "has an empty value"},
        BadCall{"KeyTwice", "sweep line --vary speed=1,2 --vary speed=1:2:3 --out @a.csv",
                "varied twice"},
        BadCall{"NoSamples", "sweep line --vary speed=1:2 --out @a.csv", "--samples: is missing"},
        BadCall{"NothingDrawn", "sweep line --vary speed=1,2 --samples 3 --out @a.csv",
                "--samples: draws nothing"},
        BadCall{"EmptyInterval", "sweep line --vary speed=2:1 --samples 3 --out @a.csv",
                "a must be < b"},
        BadCall{"TooMany", "sweep line --vary speed=1:2:99999 --vary dt=1:2:99999 --out @a.csv",
                "1e+10 samples, must be <= 1e9"},
        BadCall{"VariesTheMethod", "sweep line --vary method=dmp2,dmp3 --out @a.csv", "--method"},
        BadCall{"UnknownMethod", "sweep line --vary speed=1,2 --method x --out @a.csv",
                "must be one of dmp2"},
        BadCall{"ShardBeyond", "sweep line --vary speed=1,2 --shard 3/2 --out @a.csv",
                "--shard 3/2: must be i/n"},
        BadCall{"ShardAtTheEnd", "sweep line --vary speed=1,2 --shard 2/2 --out @a.csv", "i/n"},
        BadCall{"ShardOfWords", "sweep line --vary speed=1,2 --shard one --out @a.csv", "i/n"},
        BadCall{"NoJobs", "sweep line --vary speed=1,2 --jobs 0 --out @a.csv", "--jobs"},
        BadCall{"Unwritable", "sweep line --vary speed=1,2 --out @none/a.csv",
                "none/a.csv.json: cannot be written"},
        BadCall{"Device", "sweep line --vary speed=1,2 --out /dev/full",
                "/dev/full: is not a file"},
        BadCall{"NoOutputName", "sweep line --vary speed=1,2 --out ''", "--out: is empty"},
        BadCall{"MergesAndPlays", "sweep line --merge @b.csv --out @a.csv", "--merge"},
        BadCall{"MergesNothing", "sweep --merge @b.csv --out @a.csv",
                "b.csv.json: cannot be read"}),
    test::by_name);

}  // namespace
}  // namespace seam
