#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include <gmock/gmock.h>

#include "tests/browser.hpp"
#include "tests/refusals.hpp"

namespace seam {
namespace {

using Json = nlohmann::json;
using test::Browser;

/// A page of two scenes and two methods, which ctest has made (Results.OfABenchAreThere), opened in Chromium.
class Page : public testing::Test {
 protected:
  void SetUp() override {
    if (Browser::program().empty())
      GTEST_SKIP() << "Chromium is not installed (Debian: chromium), NOTHING OF THE PAGE IS TESTED";
    browser_.emplace();
    browser_->resize(1280, 900);
    browser_->open(results + "/report.html");
  }

  void TearDown() override {
    if (!browser_) return;
    EXPECT_THAT(browser_->errors(), testing::IsEmpty());
    EXPECT_THAT(browser_->requests(),
                testing::ElementsAre(testing::EndsWith("/bench/report.html")));
    if (const char* kept = std::getenv("SEAM_SCREENSHOTS"))
      std::ofstream(std::string(kept) + "/" + name() + ".png") << browser_->screenshot();
  }

  static std::string name() {
    return testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  Json state() { return browser_->value("seam_report.state"); }
  // Pixels of the arm's picture.
  std::vector<int> picture() { return browser_->value("seam_report.picture()"); }

  const std::string results = SEAM_RESULTS "/bench";
  std::optional<Browser> browser_;
};

TEST_F(Page, ShowsTheFiguresOfTheTerminalsTables) {
  const std::string overview = test::read_file(results + "/overview.md");
  const std::string shown = browser_->value("document.querySelector('#overview').innerText");
  for (const char* figure : {"line", "carrying", "dmp2", "dmp3", "spilled"}) {
    EXPECT_THAT(overview, testing::HasSubstr(figure));
    EXPECT_THAT(shown, testing::HasSubstr(figure));
  }
  const auto summary = Json::parse(test::read_file(results + "/summary.json"));
  const std::size_t by_scene_and_method[] = {0, 2, 1, 3, 4, 6, 5, 7};  // both arms of each
  const auto cells = browser_->value(
      "[...document.querySelectorAll('#overview tbody tr')].flatMap(r => r.cells[r.cells.length - "
      "7].textContent.split(' / '))");
  ASSERT_EQ(cells.size(), summary["runs"].size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Json& run = summary["runs"][by_scene_and_method[i]];
    const double jump = run["metrics"]["torque_jump_nm"];
    EXPECT_NEAR(std::stod(cells[i].get<std::string>()), jump, 0.006 * jump) << run["arm"];
  }
  EXPECT_THAT(browser_->value("document.querySelector('#headline').textContent").dump(),
              testing::HasSubstr("With dmp2 the torque steps by up to 40."));
}

TEST_F(Page, ZoomsAllPlotsTogether) {
  const Json whole = state()["ranges"];
  ASSERT_EQ(whole.size(), 5U);
  browser_->drag(".u-over", 0.25, 0.5);
  browser_->wait_for("seam_report.state.ranges[3][1] < 2");
  const Json zoomed = state()["ranges"];
  for (const Json& range : zoomed) {
    EXPECT_EQ(range, zoomed[0]);
    EXPECT_NEAR(range[0], 0.25 * whole[0][1].get<double>(), 0.01);
    EXPECT_NEAR(range[1], 0.5 * whole[0][1].get<double>(), 0.01);
  }
  browser_->click(".u-over", 2);
  browser_->wait_for("seam_report.state.ranges[3][1] > 3");
  EXPECT_EQ(state()["ranges"], whole);
}

TEST_F(Page, ShowsEveryTickAroundAJoin) {
  browser_->press("Home");
  browser_->press("j");
  browser_->press("j");
  browser_->wait_for("seam_report.state.ranges[0][0] > 1.2");
  EXPECT_NEAR(state()["time"], 1.25, 1e-9);
  EXPECT_NEAR(state()["ranges"][3][1], 1.29, 1e-9);
  browser_->press("0");
  browser_->wait_for("seam_report.state.ranges[0][0] === 0");
}

TEST_F(Page, MovesTheArmWithTheCursorAndByPlaying) {
  EXPECT_EQ(state()["arms"], 2);
  browser_->press("Home");
  const auto first = picture();
  std::size_t other = 0;
  for (std::size_t i = 4; i < first.size(); i += 4) other += first[i] != first[i - 4];
  EXPECT_GT(other, 400U) << "of 4096 pixels";  // an arm, not one colour
  browser_->click(".u-over");
  EXPECT_NEAR(state()["time"], 0.5 * state()["ranges"][0][1].get<double>(), 0.01);
  EXPECT_NE(picture(), first);
  browser_->press("Home");
  EXPECT_EQ(picture(), first);
  browser_->press(" ");
  browser_->wait_for("seam_report.state.time > 0.3");
  EXPECT_EQ(state()["playing"], true);
  browser_->press(" ");
  const Json paused = state();
  EXPECT_EQ(paused["playing"], false);
  EXPECT_NE(picture(), first);
  EXPECT_EQ(state()["time"], paused["time"]);
}

TEST_F(Page, FollowsTheToolInACloseUp) {
  const auto all = picture();
  browser_->press("c");
  EXPECT_NE(picture(), all);
  browser_->click("#camera");
  EXPECT_EQ(picture(), all);
}

TEST_F(Page, SwitchesScenesAndMethodsByKeys) {
  EXPECT_EQ(state()["scene"], "line");
  browser_->value("document.querySelector('[role=tab]').focus()");
  browser_->press("ArrowRight");
  browser_->wait_for("seam_report.state.scene === 'carrying'");
  EXPECT_EQ(browser_->value("document.activeElement.textContent"), "carrying");
  EXPECT_EQ(state()["ranges"].size(), 6U);  // the wave, and by how much it moves the arm
  browser_->press("1");
  EXPECT_EQ(state()["hidden"], Json::array({"dmp2"}));
  EXPECT_EQ(state()["arms"], 1);
  browser_->press("s");
  EXPECT_EQ(state()["layout"], "side");
  browser_->press("]");
  browser_->wait_for("seam_report.state.scene === 'line'");
  EXPECT_EQ(browser_->value("document.querySelector('[data-method=dmp2]').ariaPressed"), "false");
}

TEST_F(Page, ShowsOneArmOrBoth) {
  const std::string columns =
      "document.querySelectorAll('#figures tbody tr:first-child td').length";
  const std::string torque = "document.querySelectorAll('.readouts')[3].textContent";
  EXPECT_EQ(state()["on"], Json::array({"ideal", "published"}));
  EXPECT_EQ(browser_->value(columns), 4);
  EXPECT_THAT(browser_->value(torque).dump(), testing::HasSubstr(" / "));
  browser_->click("[data-arms=\"0\"]");
  EXPECT_EQ(state()["on"], Json::array({"ideal"}));
  EXPECT_EQ(state()["ranges"].size(), 4U);  // it misses nothing
  EXPECT_EQ(browser_->value(columns), 2);
  EXPECT_THAT(browser_->value(torque).dump(), testing::Not(testing::HasSubstr(" / ")));
  browser_->press("a");
  EXPECT_EQ(state()["on"], Json::array({"published"}));
  EXPECT_EQ(state()["ranges"].size(), 5U);
  EXPECT_EQ(browser_->value("document.activeElement.dataset.arms"), "1");
  EXPECT_THAT(browser_->value("document.querySelector('#headline').textContent").dump(),
              testing::HasSubstr("Largest tracking error after a join"));
  browser_->press("]");
  browser_->wait_for("seam_report.state.scene === 'carrying'");
  EXPECT_EQ(state()["on"], Json::array({"published"}));
}

TEST_F(Page, FitsAPhoneInTheDark) {
  browser_->prefer_dark(true);
  browser_->resize(360, 740, true);
  browser_->wait_for("document.querySelector('.uplot').clientWidth < 360");
  EXPECT_LE(browser_->value("document.documentElement.scrollWidth"), 360);
  EXPECT_EQ(browser_->value("getComputedStyle(document.body).backgroundColor"), "rgb(18, 21, 26)");
  browser_->press("t");
  EXPECT_EQ(browser_->value("getComputedStyle(document.body).backgroundColor"),
            "rgb(255, 255, 255)");
}

/// A folder of results of one scene and one method, a copy of what ctest has made (Results.OfARunAreThere).
class Report : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::copy(SEAM_RESULTS "/run", folder_.path("r"),
                          std::filesystem::copy_options::recursive);
  }

  test::Outcome report() {
    return test::run("report " + folder_.path("r") + " -o " + folder_.path("page.html"));
  }
  Json data() const {
    const std::string page = test::read_file(folder_.path("page.html"));
    const std::string begin = R"(id="data">)";
    const auto at = page.find(begin) + begin.size();
    return Json::parse(page.substr(at, page.find("</script>", at) - at));
  }
  void spoil(const std::string& file, const std::string& from, const std::string& to) const {
    const std::string text = test::read_file(folder_.path("r/" + file));
    folder_.write("r/" + file, test::replaced(text, from, to));
  }
  void expect_refused(const std::string& message) {
    const test::Outcome outcome = report();
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1);
    EXPECT_THAT(outcome.output, testing::HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(folder_.path("page.html")));
  }

  TempFolder folder_;
};

TEST_F(Report, HoldsWhatAScriptElementCouldNotHold) {
  ASSERT_EQ(report().status, 0);
  const Json scene = data()["scenes"][0];
  EXPECT_EQ(scene["title"], "</script><!-- <script>");
  EXPECT_EQ(scene["overrides"][0], "title=</script><!-- <script>");
  EXPECT_THAT(scene["file"].get<std::string>(), testing::HasSubstr("start_after: 0.25"));
  EXPECT_EQ(scene["runs"][0]["method"], "dmp3");
}

TEST_F(Report, IsTheOneThatTheBenchLeft) {
  ASSERT_EQ(report().status, 0);
  EXPECT_TRUE(test::read_file(folder_.path("page.html")) ==
              test::read_file(folder_.path("r/report.html")));
}

TEST_F(Report, GoesWithoutAReplayThatIsNotThere) {
  std::filesystem::remove(folder_.path("r/line/dmp3.replay.json"));
  ASSERT_EQ(report().status, 0);
  EXPECT_TRUE(data()["scenes"][0]["runs"][0]["motion"].is_null());
}

TEST_F(Report, SaysWhichMeshIsNotThereAnyMore) {
  spoil("line/dmp3.replay.json", "base_navy.obj", "gone.obj");
  ASSERT_EQ(report().status, 0);
  const Json scene = data()["scenes"][0];
  EXPECT_TRUE(scene["runs"][0]["motion"].is_null());
  EXPECT_THAT(scene["why_no_arm"].get<std::string>(), testing::HasSubstr("gone.obj"));
}

TEST_F(Report, RefusesAnotherFormat) {
  spoil("summary.json", "\"format\": 1", "\"format\": 2");
  expect_refused("summary.json: format 2, must be 1");
}

TEST_F(Report, RefusesASummaryThatIsCut) {
  folder_.write("r/summary.json", "{\"format\": 1, \"runs\": [");
  expect_refused("summary.json: is not what seam bench left: ");
}

TEST_F(Report, RefusesASummaryWithoutScenes) {
  spoil("summary.json", "\"scenes\"", "\"others\"");
  expect_refused("summary.json: is not what seam bench left: ");
}

TEST_F(Report, RefusesAMethodThatWasNotPlayed) {
  std::filesystem::remove(folder_.path("r/line/dmp3.csv"));
  expect_refused("line/dmp3.csv: cannot be read");
}

TEST_F(Report, RefusesARecordingThatIsBroken) {
  spoil("line/dmp3.csv", "ref.E1", "ref.X");
  expect_refused("line/dmp3.csv:1: reference of \"X\"");
}

TEST_F(Report, RefusesARecordingWithoutTorques) {
  const std::string text = test::read_file(folder_.path("r/line/dmp3.csv"));
  folder_.write("r/line/dmp3.csv", test::replaced_all(text, "torque.", "other."));
  expect_refused("line/dmp3.csv: has no column torque.<joint>");
}

TEST_F(Report, RefusesAReplayThatIsBroken) {
  spoil("line/dmp3.replay.json", "\"frames\"", "\"farmes\"");
  expect_refused("line/dmp3.replay.json: ");
}

TEST_F(Report, AppearsWholeOrNotAtAll) {
  const test::Outcome full = test::run("report " + folder_.path("r") + " -o /dev/full");
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.output, testing::HasSubstr("/dev/full: cannot be written: No space left"));
  std::filesystem::create_directory(folder_.path("page.html"));
  const test::Outcome outcome = report();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.output, testing::HasSubstr("page.html: cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("page.html.part")));
}

}  // namespace
}  // namespace seam
