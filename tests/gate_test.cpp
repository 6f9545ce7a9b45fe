// The gate that compares a bench's figures with those that were committed.

#include "bench/gate.hpp"

#include <gmock/gmock.h>

#include "tests/refusals.hpp"

namespace seam {
namespace {

using Kind = Difference::Kind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const char* const tolerances =
    "format: seam-tolerances 1\n"
    "metrics:\n"
    "  jump: {relative: 0.01, absolute: 0.001}\n"
    "  order: {absolute: 0.1, better: higher}\n"
    "  deviation: {relative: 0.01, better: neither}\n"
    "arms:\n"
    "  published: {jump: {relative: 0.1}, order: {absolute: 1, better: higher}}\n"
    "scenes:\n"
    "  rough: {jump: {relative: 0.5}}\n"
    "  rough-published: {order: {absolute: 2, better: higher}}\n";

class Gate : public testing::Test {
 protected:
  Gate() {
    folder_.write("tolerances.yaml", tolerances);
    Baselines(dir()).update(
        {{"line", {{"dmp3", {{"jump", 2.0}, {"order", 1.9}, {"deviation", 0.5}}}}},
         {"rough", {{"dmp3", {{"jump", 2.0}}}}}});
  }
  std::string dir() const { return folder_.path(""); }
  std::vector<std::string> differences(const Figures& now) const {
    std::vector<std::string> lines;
    for (const Difference& difference : Baselines(dir()).check(now))
      lines.push_back(to_string(difference));
    return lines;
  }

  TempFolder folder_;
};

Figures line(double jump, double order = 1.9, double deviation = 0.5) {
  return {{"line", {{"dmp3", {{"jump", jump}, {"order", order}, {"deviation", deviation}}}}}};
}

TEST_F(Gate, LetsPassWhatIsWithinTheTolerances) {
  EXPECT_THAT(differences(line(2.0)), IsEmpty());
  EXPECT_THAT(differences(line(2.0199, 1.81, 0.5049)), IsEmpty());
  EXPECT_THAT(differences(line(1.9801, 1.99, 0.4951)), IsEmpty());
}

TEST_F(Gate, NamesWhatGotWorseOrBetterByHowMuch) {
  EXPECT_THAT(differences(line(2.1)),
              ElementsAre("line dmp3: jump 2 -> 2.1, worse by 5 % (allowed: 1 %)"));
  EXPECT_THAT(differences(line(1.0)),
              ElementsAre("line dmp3: jump 2 -> 1, better by 50 % (allowed: 1 %)"));
  EXPECT_THAT(differences(line(2.0, 0.0)),
              ElementsAre(HasSubstr("order 1.9 -> 0, worse by 100 %")));
  EXPECT_THAT(differences(line(2.0, 1.9, 1.0)),
              ElementsAre(HasSubstr("deviation 0.5 -> 1, other by 100 %")));
}

TEST_F(Gate, TakesWhatCannotBeMeasuredAnyMoreForWorse) {
  EXPECT_THAT(differences(line(nan)), ElementsAre("line dmp3: jump 2 -> nan, worse"));
  EXPECT_THAT(differences(line(2.0, nan)), ElementsAre("line dmp3: order 1.9 -> nan, worse"));
  Baselines(dir()).update(line(nan));
  EXPECT_THAT(differences(line(nan)), IsEmpty());
}

TEST_F(Gate, NamesFiguresThatAreNewOrMissing) {
  EXPECT_THAT(differences({{"line", {{"dmp3", {{"jump", 2.0}, {"order", 1.9}}}}}}),
              ElementsAre("line dmp3: deviation was 0.5 and is not measured"));
  EXPECT_THAT(differences({{"other", {{"dmp3", {{"jump", 2.0}}}}}}),
              ElementsAre("other dmp3: jump 2, is not among the baselines"));
}

TEST_F(Gate, HasTolerancesOfItsOwnForAScene) {
  EXPECT_THAT(differences({{"rough", {{"dmp3", {{"jump", 2.9}}}}}}), IsEmpty());
  EXPECT_THAT(differences({{"rough", {{"dmp3", {{"jump", 3.1}}}}}}),
              ElementsAre(HasSubstr("worse")));
}

// That of the scene on the arm, of the scene, of the arm, of all.
TEST_F(Gate, HasTolerancesOfItsOwnForAnArm) {
  for (const char* scene : {"line-published", "rough-published"})
    Baselines(dir()).update({{scene, {{"dmp3", {{"jump", 2.0}, {"order", 1.9}}}}}});
  const auto on_arm = [&](const char* scene, double jump, double order) {
    return differences({{scene, {{"dmp3", {{"jump", jump}, {"order", order}}}}}});
  };
  EXPECT_THAT(on_arm("line-published", 2.19, 0.95), IsEmpty());
  EXPECT_THAT(on_arm("line-published", 2.21, 0.85),
              ElementsAre("line-published dmp3: jump 2 -> 2.21, worse by 10.5 % (allowed: 10 %)",
                          HasSubstr("order 1.9 -> 0.85, worse")));
  EXPECT_THAT(on_arm("rough-published", 2.9, -0.05), IsEmpty());
  EXPECT_THAT(on_arm("rough-published", 3.1, -0.15), testing::SizeIs(2));
}

// So that a renewal shows in a diff what has changed and nothing else.
TEST_F(Gate, RenewsWhatDiffersAndKeepsTheRest) {
  Baselines(dir()).update(line(2.001, 0.5));
  EXPECT_THAT(differences(line(2.0199, 0.5)), IsEmpty());
  const std::string text = test::read_file(folder_.path("line.json"));
  EXPECT_THAT(text, testing::AllOf(HasSubstr("\"jump\": 2.0"), HasSubstr("\"order\": 0.5")));
  EXPECT_THAT(differences({{"rough", {{"dmp3", {{"jump", 2.0}}}}}}), IsEmpty());
}

TEST_F(Gate, RefusesWhatIsNotABaseline) {
  Baselines(dir()).update({{"line", {{"dmp3", {{"wave", 1.0}}}}}});
  EXPECT_THAT(test::refusal([&] {
                differences({{"line", {{"dmp3", {{"wave", 1.0}}}}}});
              }),
              HasSubstr("tolerances.yaml: needs a tolerance of wave"));
  folder_.write("line.json", "{\"format\": 2}");
  EXPECT_THAT(test::refusal([&] { Baselines{dir()}; }),
              HasSubstr("line.json: format 2, must be 1"));
  folder_.write("line.json", "{\"format\": 1");
  EXPECT_THAT(test::refusal([&] { Baselines{dir()}; }), HasSubstr("line.json: not a baseline"));
  EXPECT_THAT(test::refusal([&] { Baselines("/nowhere"); }),
              HasSubstr("/nowhere/tolerances.yaml: cannot be read"));
  folder_.write("tolerances.yaml", "format: seam-tolerances 1\nmetrics: {jump: {absolute: -1}}");
  EXPECT_THAT(test::refusal([&] { Baselines{dir()}; }),
              HasSubstr("tolerances.yaml:2: key \"absolute\": -1, must be >= 0"));
}

}  // namespace
}  // namespace seam
