#include "bench/experiment.hpp"

#include <gmock/gmock.h>

#include "tests/refusals.hpp"

namespace seam {
namespace {

using test::BadCall;
using test::BadFile;
using test::Outcome;
using testing::AllOf;
using testing::HasSubstr;

const std::string own = SEAM_EXPERIMENTS "/";

std::vector<Measured> measured(const Experiment& experiment) {
  return perform(experiment, 2, [](int, int) {});
}

// The prices by which the methods were chosen, calculated before this library was written and without Bullet: a minimum-jerk
// movement of 1 rad in 1 s entered at 0.5 rad/s (tests/figures_test.cpp holds them to the digit; here the acceleration is differenced).
TEST(Experiment, OfKernelWidthsFindsWhatTheMethodsCost) {
  Experiment experiment = Experiment::read(own + "kernel-width.yaml");
  experiment.values = {0.75};
  const auto figures = measured(experiment).at(0).figures;
  const auto expect = [&](const char* method, double jerk, double deviation) {
    EXPECT_NEAR(figures.at(method).at("jerk_peak_rad_s3"), jerk, 1.5) << method;
    EXPECT_NEAR(figures.at(method).at("deviation_peak_rad"), deviation, 1e-3) << method;
  };
  expect("dmp3", 151.0, 0.021);
  expect("dmp2a", 59.0, 0.029);
  expect("dmp2j", 44.0, 0.035);
  EXPECT_NEAR(figures.at("dmp2").at("joint_speed_rad_s"), 0.5, 5e-3);
}

// The closed form: torque goes with the square of the speed, and so does its jump.
TEST(Experiment, OfSpeedsFindsJumpsThatGrowWithTheSquare) {
  Experiment experiment = Experiment::read(own + "speed.yaml");
  experiment.values = {0.5, 1.0};
  const auto at = measured(experiment);
  const auto jump = [&](std::size_t i) { return at[i].figures.at("dmp2").at("torque_jump_nm"); };
  EXPECT_NEAR(jump(1) / jump(0), 4.0, 0.05);
}

TEST(Experiment, AnswersWithItsFigures) {
  Experiment experiment;
  experiment.name = "some";
  experiment.text =
      "from {x first} to {x last}: {dmp3 jump least}, {dmp3 jump most}, {dmp3 jump last}";
  const std::vector<Measured> at{{1.0, {{"dmp2", {{"jump", 9.0}}}, {"dmp3", {{"jump", 0.25}}}}},
                                 {2.0, {{"dmp2", {{"jump", 9.0}}}, {"dmp3", {{"jump", 1234.5}}}}},
                                 {3.5, {{"dmp2", {{"jump", 9.0}}}, {"dmp3", {{"jump", 0.5}}}}}};
  EXPECT_EQ(answer(experiment, at), "from 1 to 3.5: 0.25, 1234, 0.5");
  for (const char* wrong : {"{dmp3 jmup first}", "{dmp9 jump first}"}) {
    experiment.text = wrong;
    EXPECT_THAT(test::refusal([&] { answer(experiment, at); }),
                HasSubstr("must name a method and a metric"));
  }
  experiment.text = "{dmp3 jump}";
  EXPECT_THAT(test::refusal([&] { answer(experiment, at); }), HasSubstr("{dmp3 jump}, must be"));
}

TEST(Experiment, RefusesAMetricThatTheSceneDoesNotHave) {
  Experiment experiment = Experiment::read(own + "speed.yaml");
  experiment.panels[0].metric = "wave_peak_m";
  EXPECT_THAT(test::refusal([&] { measured(experiment); }),
              HasSubstr("speed: metric \"wave_peak_m\" is not measured in "));
}

class ExperimentRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(ExperimentRefuses, WithFileLineAndKey) {
  const std::string good =
      test::replaced(test::read_file(own + "speed.yaml"), "../../scenes", SEAM_SCENES);
  test::expect_refused(GetParam(), good, TempFolder(),
                       [](const std::string& path) { Experiment::read(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , ExperimentRefuses,
    testing::Values(
        BadFile{"Format", "seam-experiment 1", "seam-experiment 2", ":1: key \"format\""},
        BadFile{"NoScene", "scene:", "seen:", ":3: key \"seen\": not known here"},
        BadFile{"NoValues", "[0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2]", "[]",
                ":5: key \"values\": must be a list with at least one"},
        BadFile{"ValuesThatFall", "0.25, 0.5,", "0.5, 0.25,", ":5: key \"values\": must increase"},
        BadFile{"NotANumber", "0.25, 0.5,", "0.25, nan,", ":5: key \"values\": \"nan\""},
        BadFile{"RangeOfOne", "[0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2]",
                "{from: 1, to: 2, count: 1}", ":5: key \"count\": \"1\", must be"},
        BadFile{"RangeOfMany", "[0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2]",
                "{from: 1, to: 2, count: 1001}", ":5: key \"count\": 1001, must be"},
        BadFile{"UnknownScale", "scale: log", "scale: polar", ":8: key \"scale\""}),
    test::by_name);

// The committed answers are what the program says.
TEST(ExperimentCommand, GivesTheCommittedAnswer) {
  const TempFolder folder;
  const std::string all = test::read_file(own + "README.md");
  for (const char* name : {"kernel-width", "lag"}) {
    const Outcome outcome =
        test::run("experiment " + std::string(name) + " --out " + folder.path(""));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(all, HasSubstr(test::read_file(folder.path(std::string(name) + ".md"))));
    EXPECT_GT(test::read_file(folder.path(std::string(name) + ".png")).size(), 10000U);
  }
}

TEST(ExperimentCommand, AsksAUsersOwnScene) {
  const TempFolder folder;
  const std::string scene = folder.write("mine.yaml", test::scene_text("line"));
  const Outcome outcome = test::run("experiment speed --scene " + scene +
                                    " --values 0.5,1 --set settle=0.5 --out " + folder.path("r"));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr(" 0.5 |  "), HasSubstr("speed.png")));
  const Outcome list = test::run("experiment --list");
  EXPECT_THAT(list.output, AllOf(HasSubstr("kernel-width "), HasSubstr("spilling ")));
}

class ExperimentCommandRefuses : public testing::TestWithParam<BadCall> {};

TEST_P(ExperimentCommandRefuses, WithOneLineAndExitCodeTwo) {
  test::expect_refused(GetParam(), TempFolder());
}

INSTANTIATE_TEST_SUITE_P(
    , ExperimentCommandRefuses,
    testing::Values(
        BadCall{"Unknown", "experiment alchemy", "alchemy.yaml: cannot be read"},
        BadCall{"UnknownScene", "experiment lag --scene nowhere", "nowhere.yaml: cannot be read"},
        BadCall{"ValuesThatFall", "experiment lag --values 2,1", "--values: must increase"},
        BadCall{"ValueRefused", "experiment lag --values -1 --out @", "key \"lag\": -1, must be"},
        BadCall{"NoFolder", "experiment lag --values 0 --out /proc/seam", "/proc/seam"}),
    test::by_name);

}  // namespace
}  // namespace seam
