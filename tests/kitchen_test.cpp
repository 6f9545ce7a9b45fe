// The paper's experiments in task space: what the comparison of the joins claims of them.

#include <cstring>

#include <gmock/gmock.h>

#include "bench/compare.hpp"
#include "scenes/play.hpp"
#include "tests/own_scene.hpp"
#include "tests/refusals.hpp"

namespace seam {
namespace {

using test::outcome;
using test::own_scene;
using testing::HasSubstr;

// One of the project's scenes, or of the tests', in which a text is replaced by another.
Scene scene_with(const std::string& name, const std::string& from, const std::string& to) {
  const TempFolder folder;
  return Scene::read(
      folder.write(name + ".yaml", test::replaced(test::scene_text(name), from, to)));
}

// A hand that reaches for a glass that is carried past, as a camera sees it.
Scene moving_goal() {
  return scene_with("moving_goal", "seed: 1", "seed: 1");
}

std::vector<seam::Run> compared(const Scene& scene) {
  const std::vector<Join> methods(all_joins.begin(), all_joins.end());
  const auto quiet = [](int, int, const std::string&) {};
  return compare({scene}, methods, 2, quiet).front().runs;
}

class KitchenScene : public testing::TestWithParam<const char*> {};

// At every join and change of goal; the order where nothing but the arm moves.
TEST_P(KitchenScene, TorqueStepsWithDmp2AndNotWithTheOthers) {
  const Scene played = own_scene(GetParam());
  const std::vector<seam::Run> runs = compared(played);
  const bool alone = !played.liquid && !played.pouring;
  const auto& dmp2 = runs[0].metrics.joins;
  EXPECT_GT(dmp2.size(), 1U);
  for (const seam::Run& run : runs) {
    EXPECT_EQ(outcome(run.recording, "stopped_share"), 0.0);
    if (alone) {
      EXPECT_LT(run.metrics.tool_tracking_max_m, 1e-6);
    }
    if (run.method == Join::dmp2) continue;
    EXPECT_LT(run.metrics.acceleration_jump_m_s2,
              1e-9 * run.recording.tool_acc.cwiseAbs().maxCoeff());
    for (std::size_t j = 0; j < dmp2.size(); ++j) {
      EXPECT_LE(run.metrics.joins[j].torque_jump_nm, 0.02 * dmp2[j].torque_jump_nm)
          << to_string(run.method) << " at " << dmp2[j].time << " s";
      if (alone && dmp2[j].torque_jump_nm > 1.0) {
        EXPECT_GE(run.metrics.joins[j].torque_jump_order, 0.9)
            << to_string(run.method) << " at " << dmp2[j].time;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, KitchenScene,
                         testing::Values("carrying", "wiping", "through", "obstacle"));

// Two changes a tick apart from a camera's 30 a second leave jumps of dmp2 that vanish by chance: the worst counts.
TEST(MovingGoal, TorqueStepsWithDmp2AtTheGoalsAndNotWithTheOthers) {
  const std::vector<seam::Run> runs = compared(moving_goal());
  EXPECT_EQ(runs[0].metrics.joins.size(), 32U);
  EXPECT_GT(runs[0].metrics.torque_jump_nm, 3.0);
  for (const seam::Run& run : {runs[1], runs[2], runs[3]}) {
    EXPECT_LT(run.metrics.torque_jump_nm, 0.02 * runs[0].metrics.torque_jump_nm);
    EXPECT_LT(run.metrics.tool_tracking_max_m, 1e-6);
    EXPECT_LT(run.metrics.acceleration_jump_m_s2, 1e-9);
  }
}

// Each picture moves the hit: the price of the camera's noise is the miss.
TEST(Catching, HandAndBallMeetWithAnyMethodAndTorqueStepsWithDmp2Alone) {
  const std::vector<seam::Run> runs = compared(own_scene("catching"));
  EXPECT_GT(runs[0].metrics.torque_jump_nm, 3.0);
  for (const seam::Run& run : runs) {
    SCOPED_TRACE(to_string(run.method));
    EXPECT_LT(outcome(run.recording, "miss_m"), 0.005);
    EXPECT_LT(outcome(run.recording, "velocity_miss_m_s"), 0.03);
    EXPECT_LT(outcome(run.recording, "time_miss_s"), 0.005);
    EXPECT_LT(run.metrics.tool_tracking_max_m, 1e-6);
    if (run.method == Join::dmp2) continue;
    EXPECT_LT(run.metrics.torque_jump_nm, 0.02 * runs[0].metrics.torque_jump_nm);
    EXPECT_LT(run.metrics.acceleration_jump_m_s2,
              1e-9 * run.recording.tool_acc.cwiseAbs().maxCoeff());
  }
}

TEST(Catching, MissesNothingWhereTheCameraIsExact) {
  const Scene exact = own_scene("catching", {"ball.seen.noise=0"});
  for (const Join method : all_joins) {
    const Recording recording = play(exact, method, exact.dt);
    EXPECT_LT(outcome(recording, "miss_m"), 1e-8) << to_string(method);
    EXPECT_LT(outcome(recording, "velocity_miss_m_s"), 0.02) << to_string(method);
    EXPECT_LT(outcome(recording, "time_miss_s"), 1e-3) << to_string(method);
    const Scene blind =
        own_scene("catching", {"ball.seen={from: 0.75, to: 0.76, every: 0.01, noise: 0.02}"});
    EXPECT_GT(outcome(play(blind, method, exact.dt), "miss_m"), 0.03) << to_string(method);
  }
}

TEST(Catching, BringsHandAndBallToRest) {
  const Scene catching = own_scene("catching");
  for (const Join method : all_joins) {
    const Recording recording = play(catching, method, catching.dt);
    EXPECT_LT(recording.tool_vel.bottomRows<500>().cwiseAbs().maxCoeff(), 1e-9)
        << to_string(method);
  }
}

TEST(Through, ClearsTheGatesWithItsWishesAlone) {
  const Scene through = own_scene("through");
  const Scene without = own_scene("through", {"sequence.steps.1={play: thread}"});
  for (const Join method : all_joins) {
    const Recording recording = play(through, method, through.dt);
    EXPECT_NEAR(outcome(recording, "clearance_m"), 0.015, 1e-4) << to_string(method);
    EXPECT_LT(recording.tool_vel.bottomRows<900>().cwiseAbs().maxCoeff(), 1e-9)
        << to_string(method);
    EXPECT_LT(outcome(play(without, method, through.dt), "clearance_m"), -0.01)
        << to_string(method);
  }
}

TEST(Obstacle, IsTouchedWithoutTheCouplingAlone) {
  const Scene round = own_scene("obstacle");
  const Scene through = own_scene("obstacle", {"sequence.couplings.0.box.strength=0"});
  for (const Join method : all_joins) {
    SCOPED_TRACE(to_string(method));
    const Recording kept_off = play(round, method, round.dt);
    EXPECT_EQ(outcome(kept_off, "touched_share"), 0.0);
    EXPECT_GT(outcome(kept_off, "obstacle_distance_m"), 0.005);
    const Recording touching = play(through, method, round.dt);
    EXPECT_GT(outcome(touching, "touched_share"), 0.01);
    EXPECT_LT(outcome(touching, "obstacle_distance_m"), -0.01);
  }
}

TEST(Carrying, SpillsWithDmp2AndNotWithTheOthers) {
  const Scene carrying = own_scene("carrying");
  for (const Join method : all_joins) {
    const Recording recording = play(carrying, method, carrying.dt);
    const double spilled = outcome(recording, "spilled_share");
    EXPECT_EQ(spilled > 0.0, method == Join::dmp2) << to_string(method) << " " << spilled;
    EXPECT_EQ(outcome(recording, "wave_peak_m") > 0.010, method == Join::dmp2);
    EXPECT_EQ(recording.signals.at(0).values.maxCoeff(), outcome(recording, "wave_peak_m"));
  }
}

TEST(Carrying, IsTrackedExactlyWithItsLiquidFrozen) {
  const Scene frozen = scene_with("carrying", "radius: 0.035", "frozen: yes");
  const Recording recording = play(frozen, Join::dmp3, frozen.dt);
  EXPECT_LT(measure(recording).tool_tracking_max_m, 1e-6);
  // And the liquid that the controller does not know of is felt.
  const Scene moving = own_scene("carrying");
  EXPECT_GT(measure(play(moving, Join::dmp3, moving.dt)).tool_tracking_max_m, 1e-5);
}

TEST(Pouring, TorqueStepsWithDmp2AndNotWithTheOthers) {
  Scene pouring = own_scene("pouring");
  pouring.pouring->places.resize(1);
  const std::vector<seam::Run> runs = compared(pouring);
  for (const seam::Run& run : {runs[1], runs[2], runs[3]})
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_LE(run.metrics.joins[j].torque_jump_nm, 0.02 * runs[0].metrics.joins[j].torque_jump_nm)
          << to_string(run.method);
}

TEST(Pouring, MissesAGlassThatStandsElsewhere) {
  Scene pouring = own_scene("pouring");
  ASSERT_EQ(pouring.places(), 5U);
  pouring.pouring->places.resize(2);
  pouring.pouring->glass_at.x() += 0.15;
  EXPECT_EQ(outcome(play(pouring, Join::dmp3, pouring.dt), "poured_share"), 0.0);
}

TEST(Pouring, IsTrackedExactlyWithItsGrainsFrozen) {
  const Scene frozen = scene_with("pouring", "mass: 0.0013", "mass: 0.0013, frozen: yes");
  EXPECT_LT(measure(play(frozen, Join::dmp3, frozen.dt)).tool_tracking_max_m, 1e-6);
}

TEST(Pouring, GivesTheSameBitsTwice) {
  Scene pouring = own_scene("pouring");
  pouring.pouring->places.resize(1);
  const Recording first = play(pouring, Join::dmp2a, pouring.dt);
  const Recording second = play(pouring, Join::dmp2a, pouring.dt);
  ASSERT_EQ(first.torque.size(), second.torque.size());
  EXPECT_EQ(std::memcmp(first.torque.data(), second.torque.data(),
                        sizeof(double) * static_cast<std::size_t>(first.torque.size())),
            0);
}

// A lag leaves the arm behind; an effort limit far above what is needed does nothing.
TEST(Scene, HasTheActuatorThatItNames) {
  const auto tracking = [](const char* actuator) {
    const Scene with = scene_with("moving_goal", "seed: 1",
                                  "method: dmp2a\nseed: 1\nactuator: " + std::string(actuator));
    EXPECT_EQ(with.method, Join::dmp2a);
    return measure(play(with, Join::dmp3, with.dt)).tool_tracking_max_m;
  };
  EXPECT_LT(tracking("ideal"), 1e-9);
  EXPECT_LT(tracking("{effort_limit: yes}"), 1e-9);
  EXPECT_GT(tracking("{lag: 0.002}"), 1e-5);
}

// Twice as fast a sequence is at the same place at half the time.
TEST(Scene, HastenedIsOnTheSamePath) {
  const Scene slow = own_scene("carrying");
  const Scene fast = own_scene("carrying", {"speed=2"});
  const Recording before = play(slow, Join::dmp2, 1e-3);
  const Recording after = play(fast, Join::dmp2, 5e-4);
  ASSERT_EQ(before.ticks(), after.ticks());
  EXPECT_LT((before.tool_ref - after.tool_ref).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((2.0 * before.tool_vel - after.tool_vel).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Camera, SeesAGoalThatMovesWithNoise) {
  const Scene catching = moving_goal();
  ASSERT_EQ(catching.events.size(), 31U);
  double square = 0.0;
  for (const Event& event : catching.events) {
    const double t = event.at - 0.4;
    const Eigen::Vector3d true_goal(0.58 - 0.04 * t, -0.06 + 0.12 * t, 0.2);
    const Eigen::Vector3d noise = event.goal - true_goal;
    EXPECT_EQ(noise.z() != 0.0, true);
    square += noise.squaredNorm() / 93.0;
  }
  EXPECT_NEAR(std::sqrt(square), 0.002, 0.0004);
  EXPECT_EQ(moving_goal().events[7].goal, catching.events[7].goal);
  EXPECT_NE(scene_with("moving_goal", "seed: 1", "seed: 2").events[7].goal,
            catching.events[7].goal);
}

struct BadScene {
  const char* name;
  const char* scene;
  const char* from;
  const char* to;
  const char* message;
};

class KitchenRefuses : public testing::TestWithParam<BadScene> {};

TEST_P(KitchenRefuses, WithFileLineAndKey) {
  const BadScene& bad = GetParam();
  EXPECT_THAT(test::refusal([&] { scene_with(bad.scene, bad.from, bad.to); }),
              HasSubstr(bad.message));
}

INSTANTIATE_TEST_SUITE_P(
    , KitchenRefuses,
    testing::Values(
        BadScene{"UnknownLink", "carrying", "link: tool", "link: spoon", ":9: key \"link\": "},
        BadScene{"TurnedByNothing", "carrying", "[0, 1, 0, 0]", "[0, 0, 0, 0]",
                 ":10: key \"turned\""},
        BadScene{"NoBottom", "carrying", "bottom:", "botom:", ":13: key \"botom\": not known here"},
        BadScene{"NegativeRadius", "carrying", "radius: 0.035", "radius: -1",
                 ":14: key \"radius\": -1, must be >= 0"},
        BadScene{"EmptyGlass", "carrying", "depth: 0.07", "depth: 0",
                 ":12: key \"liquid\": liquid: depth 0.000000, must be > 0"},
        BadScene{"FrozenPerhaps", "carrying", "rim: 0.010", "frozen: perhaps",
                 ":16: key \"frozen\": \"perhaps\", must be "},
        BadScene{"AlphaThatIsNotANumber", "moving_goal", "carry_lift.csv",
                 "wipe_away.csv, alpha: nan", "key \"alpha\""},
        BadScene{"CameraThatLooksBack", "moving_goal", "to: 1.4", "to: 0.1",
                 "key \"to\": 0.1, must be >= from"},
        BadScene{"CameraOfTooManyPictures", "moving_goal", "every: 0.033333", "every: 1e-9",
                 "key \"every\": gives more than 1e5 events"},
        BadScene{"UnknownActuator", "catching", "seed: 1", "actuator: strong",
                 "key \"actuator\": \"strong\", must be one of ideal"},
        BadScene{"UnknownMethod", "catching", "seed: 1", "method: dmp9",
                 "key \"method\": method \"dmp9\": not known"},
        BadScene{"TooManyGrains", "pouring", "count: 32", "count: 0",
                 "key \"count\": \"0\", must be a whole number >= 1"},
        BadScene{"PlaceOfTwoNumbers", "pouring", "[0.04, 0, 0]", "[0.04, 0]", "key \"places\""},
        BadScene{"GlassWithoutAPlace", "pouring", "at: [", "att: [", "key \"att\""}),
    test::by_name);

TEST(Pouring, RefusesGrainsThatDoNotFitBeforeTheyArePlayed) {
  const Scene full = scene_with("pouring", "count: 32", "count: 900");
  EXPECT_THAT(test::refusal([&] { play(full, Join::dmp2, full.dt); }),
              HasSubstr("do not fit into the vessel"));
}

TEST(Scene, RefusesAGoalThatTheToolCannotReach) {
  const TempFolder folder;
  folder.write("far.csv",
               "time,x,y,z\n0,0.45,-0.3,0.06\n0.3,0.7,0,0.1\n0.5,1,0,0.1\n0.7,1.5,0,0.2\n1,1.9,0,0."
               "2\n1.1,1.9,0,0.2\n");
  const std::string text = test::replaced(test::scene_text("carrying"),
                                          "kernels: 10, width: 1.0, cutoff: 4}", "kernels: 2}");
  const std::size_t at = text.find("demonstration: ");
  const std::size_t end = text.find(".csv", at) + 4;
  const std::string path =
      folder.write("far.yaml", text.substr(0, at) + "demonstration: far.csv" + text.substr(end));
  EXPECT_THAT(test::refusal([&] { Scene::read(path); }), HasSubstr("out of reach by "));
}

}  // namespace
}  // namespace seam
