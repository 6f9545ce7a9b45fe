#include "scenes/replay.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "scenes/base64.hpp"
#include "scenes/play.hpp"
#include "tests/refusals.hpp"
#include <seam/kinematics.hpp>

namespace seam {
namespace {

using test::BadFile;

struct Played {
  Scene scene;
  Recording recording;
  Replay replay;
};

Played played(const std::string& name, const std::vector<std::string>& overrides = {}) {
  Played run{Scene::read(std::string(SEAM_SCENES) + "/" + name + ".yaml", overrides), {}, {}};
  run.recording = play(run.scene, Join::dmp2, run.scene.dt, &run.replay);
  return run;
}

// The last tick at or before the frame's time.
Eigen::Index tick_of(Eigen::Index frame, const Played& run) {
  return static_cast<Eigen::Index>(
      std::floor(static_cast<double>(frame) / (60.0 * run.scene.dt) + 1e-6));
}

// Poses against the product of exponentials of the recorded joint positions.
TEST(Replay, ShowsTheToolWhereTheRecordedJointsPutIt) {
  const Played run = played("carrying");
  Kinematics tool(run.scene.robot, run.scene.tool->link, run.scene.tool->X_link_tool);
  ASSERT_EQ(run.replay.frames(),
            1 + static_cast<Eigen::Index>((run.recording.ticks() - 1) * 60 * run.scene.dt + 1e-6));
  for (Eigen::Index i = 0; i < run.replay.frames(); ++i) {
    tool.move_to(run.recording.q.row(tick_of(i, run)).transpose());
    const Eigen::Isometry3d& X = tool.X_base_tool();
    EXPECT_LT((run.replay.tool.row(i).transpose().cast<double>() - X.translation()).norm(), 1e-6);
    const Eigen::Isometry3d glass =
        run.replay.pose(i, static_cast<std::size_t>(run.replay.liquid->part));
    EXPECT_LT((X * Eigen::Vector3d(0, 0, -0.06) - glass.translation()).norm(), 1e-6);
    EXPECT_LT((X.linear() - glass.linear()).norm(), 1e-5);
  }
}

TEST(Replay, HasTheWaveTheSpillTheRunningPrimitiveAndTheJoinsOfTheRecording) {
  const Played run = played("carrying");
  const Replay::Liquid& liquid = *run.replay.liquid;
  for (Eigen::Index i = 0; i < run.replay.frames(); ++i) {
    const Eigen::Index tick = tick_of(i, run);
    EXPECT_NEAR(liquid.waves.row(i).norm(), run.recording.signals[0].values(tick), 1e-8);
    EXPECT_EQ(run.replay.running[static_cast<std::size_t>(i)], run.recording.running(tick));
  }
  EXPECT_EQ(liquid.spilled(0, 0), 0.0F);
  EXPECT_NEAR(liquid.spilled(run.replay.frames() - 1, 0), run.recording.outcomes[1].value, 1e-6);
  EXPECT_THAT(run.replay.joins, testing::ElementsAre(0.25, testing::DoubleNear(0.83, 1e-9)));
  EXPECT_THAT(run.replay.primitives, testing::ElementsAre("lift", "place"));
}

TEST(Replay, ShowsEveryGrainThatWasPouredInTheGlass) {
  const Replay replay = played("pouring", {"pouring.places=[[0.04, 0, 0]]"}).replay;
  const auto last = replay.grains->positions.bottomRows<1>();
  ASSERT_EQ(last.size(), 3 * 32);
  for (Eigen::Index i = 0; i < 32; ++i) {
    EXPECT_LT(std::hypot(last(3 * i) - 0.78F, last(3 * i + 1) - 0.13F), 0.045F);
    EXPECT_GT(last(3 * i + 2), 0.10F);
  }
}

// A tick may be longer than a frame.
TEST(Replay, HasAFrameAtEverySixtiethOfASecondWhateverTheTick) {
  const Played coarse = played("line", {"dt=0.025", "control.Kp=100", "control.Kd=20"});
  EXPECT_EQ(coarse.replay.frames(),
            1 + static_cast<Eigen::Index>((coarse.recording.ticks() - 1) * 60 * 0.025 + 1e-6));
  EXPECT_TRUE(coarse.replay.tool.row(1) == coarse.replay.tool.row(0));
}

TEST(Replay, ComesBackFromItsFileAsItWas) {
  const TempFolder folder;
  for (const char* scene : {"carrying", "line"}) {
    const Replay replay = played(scene).replay;
    replay.write(folder.path("a.json"));
    const Replay back = Replay::read(folder.path("a.json"));
    back.write(folder.path("b.json"));
    EXPECT_TRUE(test::read_file(folder.path("a.json")) == test::read_file(folder.path("b.json")));
    EXPECT_TRUE(back.poses == replay.poses);
    EXPECT_EQ(back.parts.size(), replay.parts.size());
  }
}

// RFC 4648, section 10.
TEST(Base64, IsAsTheStandardSays) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

class ReplayRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(ReplayRefuses, WhatIsNoReplay) {
  const TempFolder folder;
  static const Replay replay = played("line").replay;
  replay.write(folder.path("good.json"));
  test::expect_refused(GetParam(), test::read_file(folder.path("good.json")), folder,
                       [](const std::string& path) { Replay::read(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , ReplayRefuses,
    testing::Values(BadFile{"NotJson", "{\"format\"", "format", ": no replay: "},
                    BadFile{"NewerFormat", "\"format\":1", "\"format\":2", ": format 2, must be 1"},
                    BadFile{"NoTool", "\"tool\"", "\"fool\"", ": no replay: "},
                    BadFile{"NotBase64", "\"tool\":\"", "\"tool\":\"????", ": '?' is not base64"},
                    BadFile{"ToolCutShort", "\"tool\":\"", "\"tool\":\"AAAAAAAAAAAAAAAA",
                            ": tool of "},
                    BadFile{"UnknownShape", "\"type\":\"mesh\"", "\"type\":\"cone\"",
                            ": shape \"cone\", must be"}),
    test::by_name);

}  // namespace
}  // namespace seam
