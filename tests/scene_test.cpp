#include "scenes/scene.hpp"

#include <cstring>

#include <gmock/gmock.h>

#include "bench/compare.hpp"
#include "scenes/play.hpp"
#include "tests/refusals.hpp"
#include <seam/metrics.hpp>

namespace seam {
namespace {

using test::BadFile;
using testing::HasSubstr;

const std::string line = std::string(SEAM_SCENES) + "/line.yaml";

std::vector<seam::Run> compared(const std::string& path, int jobs) {
  const std::vector<Join> methods(all_joins.begin(), all_joins.end());
  const auto quiet = [](int, int, const std::string&) {};
  return compare({Scene::read(path)}, methods, jobs, quiet).front().runs;
}

bool same_bits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

bool same_bits(const Recording& a, const Recording& b) {
  return same_bits(a.ref, b.ref) && same_bits(a.ref_vel, b.ref_vel) &&
         same_bits(a.ref_acc, b.ref_acc) && same_bits(a.q, b.q) && same_bits(a.qd, b.qd) &&
         same_bits(a.torque, b.torque);
}

// What is wished on the way is there when it is to be, on the arm, and is made and moved without a step in torque.
TEST(LineScene, PassesAndHitsWhereAnEventWishesIt) {
  const Scene scene = Scene::read(
      line, {"events=[{at: 0.4, pass: {E1: 1.0}, when: 0.85}, {at: 0.5, pass: {E1: 1.1}, "
             "when: 0.9, wish: 0}, {at: 1.3, hit: {E1: 1.2}, velocity: {E1: -0.2}, when: 1.8}]"});
  for (const Join method : all_joins) {
    const Recording run = play(scene, method, 1e-3);
    EXPECT_NEAR(run.q(900, 3), 1.1, 1e-9) << to_string(method);
    EXPECT_NEAR(run.q(1800, 3), 1.2, 1e-9) << to_string(method);
    EXPECT_NEAR(run.qd(1800, 3), -0.2, 0.02) << to_string(method);
    for (const RecordedJoin& join : run.joins) {
      const bool wished = join.time == 0.4 || join.time == 0.5 || join.time == 1.3;
      EXPECT_LE(wished ? join.acceleration_jump : 0.0, 1e-9) << to_string(method);
    }
  }
}

// The bars of the comparison, at every join, the start included.
TEST(LineScene, TorqueStepsWithDmp2AndNotWithTheOthers) {
  const std::vector<seam::Run> runs = compared(line, 2);
  const seam::Run& dmp2 = runs[0];
  ASSERT_EQ(dmp2.metrics.joins.size(), 2U);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_GT(dmp2.metrics.joins[j].torque_jump_nm, 10.0);
    EXPECT_NEAR(dmp2.metrics.joins[j].torque_jump_order, 0.0, 0.1);
    for (const seam::Run* run : {&runs[1], &runs[2]}) {
      EXPECT_LE(run->metrics.joins[j].torque_jump_nm, 0.02 * dmp2.metrics.joins[j].torque_jump_nm)
          << to_string(run->method);
      EXPECT_GE(run->metrics.joins[j].torque_jump_order, 0.9) << to_string(run->method);
      EXPECT_LE(run->metrics.joins[j].acceleration_jump_rad_s2,
                1e-9 * run->recording.ref_acc.cwiseAbs().maxCoeff());
    }
  }
}

TEST(LineScene, IsTrackedExactly) {
  for (const seam::Run& run : compared(line, 2))
    EXPECT_LE(run.metrics.tracking_max_rad, 1e-9) << to_string(run.method);
}

TEST(LineScene, StaysWithinTheLimitsOfTheArm) {
  const Scene scene = Scene::read(line);
  for (const Join method : all_joins) {
    const Recording recording = play(scene, method, scene.dt);
    for (int j = 0; j < scene.robot.dof(); ++j) {
      const Joint& joint = scene.robot.joints[static_cast<std::size_t>(j)];
      EXPECT_LT(recording.torque.col(j).cwiseAbs().maxCoeff(), joint.effort) << joint.name;
      EXPECT_LT(recording.qd.col(j).cwiseAbs().maxCoeff(), joint.speed) << joint.name;
    }
  }
}

TEST(LineScene, GivesTheSameBitsTwiceAndWithAnyNumberOfJobs) {
  const std::vector<seam::Run> alone = compared(line, 1);
  for (const int jobs : {1, 2, 5}) {
    const std::vector<seam::Run> again = compared(line, jobs);
    for (std::size_t i = 0; i < alone.size(); ++i)
      EXPECT_TRUE(same_bits(alone[i].recording, again[i].recording)) << jobs << " jobs, run " << i;
  }
}

// A goal that moves on the way steps the acceleration by K·Δg/τ² with dmp2 and not with the others.
// By name in the scene's sequence: a ball beside what the path would be. All of it is hastened with the scene.
TEST(SceneCouplings, KeepTheToolAway) {
  const auto path = [](const std::vector<std::string>& overrides) {
    std::vector<std::string> all{"liquid.frozen=yes"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const Scene scene = Scene::read(std::string(SEAM_SCENES) + "/carrying.yaml", all);
    return Eigen::MatrixX3d(play(scene, Join::dmp3, 2e-3).tool_ref.leftCols(3));
  };
  const Eigen::MatrixX3d alone = path({});
  const Eigen::RowVector3d at = alone.row(400) + Eigen::RowVector3d(0.01, 0.0, 0.01);
  std::ostringstream ball;
  ball << "sequence.couplings=[{ball: {at: [" << at.format(Eigen::IOFormat(6, 0, ", ", ", "))
       << "], radius: 0.05}, appears: {from: 0.2}}]";
  const auto nearest = [&](const Eigen::MatrixX3d& points) {
    return (points.rowwise() - at).rowwise().norm().minCoeff();
  };
  EXPECT_LT(nearest(alone), 0.02);
  EXPECT_GT(nearest(path({ball.str()})), 0.07);
  EXPECT_NEAR(nearest(path({ball.str(), "speed=1.5"})), nearest(path({ball.str()})), 1e-3);
}

TEST(SceneEvents, ChangeTheGoalOnTheWayAndAreMeasuredLikeJoins) {
  const TempFolder folder;
  const std::string path =
      folder.write("moved.yaml", test::replaced(test::scene_text("line"), "figure:",
                                                "events:\n"
                                                "  - {at: 0.6, goal: {E1: 1.5}}\n"
                                                "  - {at: 1.6, rate: 0.5, over: 0.2}\n"
                                                "figure:"));
  const std::vector<seam::Run> runs = compared(path, 2);
  const seam::Run& dmp2 = runs[0];
  ASSERT_EQ(dmp2.metrics.joins.size(), 4U);
  EXPECT_EQ(dmp2.metrics.joins[1].time, 0.6);
  EXPECT_EQ(dmp2.recording.joins[1].primitive, 0);
  EXPECT_NEAR(dmp2.metrics.joins[1].acceleration_jump_rad_s2, 200.0 * 0.1, 1e-6);
  EXPECT_GT(dmp2.metrics.joins[1].torque_jump_nm, 10.0);
  for (const seam::Run& run : {runs[1], runs[2], runs[3]}) {
    EXPECT_LT(run.metrics.joins[1].acceleration_jump_rad_s2, 1e-9);
    EXPECT_LT(run.metrics.joins[1].torque_jump_nm, 0.02 * dmp2.metrics.joins[1].torque_jump_nm);
    EXPECT_GE(run.metrics.joins[3].torque_jump_order, 0.9);
  }
}

class SceneRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(SceneRefuses, WithFileLineAndKey) {
  test::expect_refused(GetParam(), test::scene_text("line"), TempFolder(),
                       [](const std::string& path) { Scene::read(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , SceneRefuses,
    testing::Values(
        BadFile{"Format", "seam-scene 1", "seam-scene 7",
                ":2: key \"format\": \"seam-scene 7\", must be seam-scene 1"},
        BadFile{"NoTitle", "title:", "#", ":2: needs the key \"title\""},
        BadFile{"UnknownKey", "settle:", "settel:",
                ":19: key \"settel\": not known here, must be one of format, title"},
        BadFile{"NoUrdf", "pa10.urdf", "pa11.urdf", ":6: key \"urdf\": "},
        BadFile{"UnknownJoint", "S2: 0.5", "S9: 0.5", ":7: key \"S9\": "},
        BadFile{"StartOutOfReach", "S2: 0.5", "S2: 2.5", ":7: key \"S2\": 2.5, must be in -1.64"},
        BadFile{"StartNotANumber", "S2: 0.5", "S2: half",
                ":7: key \"S2\": \"half\", must be a finite number"},
        BadFile{"StartTwice", "S2: 0.5", "E1: 0.5", ":7: key \"E1\": appears twice"},
        BadFile{"NoDemonstration", "ramp_up.csv", "ramp_op.csv", ":12: key \"demonstration\": "},
        BadFile{"TooManyKernels", "kernels: 10}", "kernels: 60}", ":12: key \"demonstration\": "},
        BadFile{"FewKernels", "kernels: 10}", "kernels: 1}",
                ":12: key \"kernels\": \"1\", must be a whole number >= 2"},
        BadFile{"UnknownPrimitive", "play: down", "play: dwon",
                ":16: key \"play\": \"dwon\", is not among the primitives"},
        BadFile{"SwitchTooEarly", "before_end: 0.0", "before_end: 1.5",
                ":15: key \"until\": sequence: primitive 1: its"},
        BadFile{"TwoSwitches", "before_end: 0.0", "before_end: 0.0, after: 1.0",
                ":15: key \"until\": must have one of after, before_end, at_phase"},
        BadFile{"ZeroTick", "dt: 0.001", "dt: 0", ":18: key \"dt\": 0, must be > 0"},
        BadFile{"LongTick", "dt: 0.001", "dt: 10", ":18: key \"dt\": 10, must be in 1e-6 to 0.1 s"},
        BadFile{"EndlessSettling", "settle: 1.0", "settle: 1e12",
                ":19: key \"settle\": 1e12, must be <= 3600 s"},
        BadFile{"EndlessRun", "settle: 1.0", "duration: 3601",
                ":19: key \"duration\": 3601, must be <= 3600 s"},
        BadFile{"UnknownDuration", "play: down", "play: down, until: on_call",
                ":9: key \"sequence\": has no end that is known beforehand"},
        BadFile{"SettlingBesideADuration", "settle: 1.0", "settle: 1.0\nduration: 3",
                ":19: key \"settle\": has no meaning beside duration"},
        BadFile{"EventOfNothing", "settle: 1.0", "events: [{at: 1}]",
                ":19: key \"events\": must have one of goal, tau"},
        BadFile{"EventOfTwoThings", "settle: 1.0", "events: [{at: 1, tau: 1, amplitude: 1}]",
                ":19: key \"events\": must have one of goal, tau"},
        BadFile{"EventBeforeTheRun", "settle: 1.0", "events: [{at: -1, tau: 1}]",
                ":19: key \"at\": -1, must be >= 0"},
        BadFile{"GoalOfNoCoordinate", "settle: 1.0", "events: [{at: 1, goal: {x: 1}}]",
                ":19: key \"x\": is not among the primitives' coordinates"},
        BadFile{"WishWithoutItsMoment", "settle: 1.0", "events: [{at: 1, pass: {E1: 1}}]",
                ":19: key \"events\": needs the key \"when\""},
        BadFile{"WishForThePast", "settle: 1.0", "events: [{at: 1, hit: {E1: 1}, when: 0.5}]",
                ":19: key \"when\": must be later than at"},
        BadFile{"VelocityOfNoWish", "settle: 1.0", "events: [{at: 1, tau: 1, velocity: {E1: 1}}]",
                ":19: key \"velocity\": goes with pass and hit alone"},
        BadFile{"RateWithoutATime", "settle: 1.0", "events: [{at: 1, rate: 0.5}]",
                ":19: key \"events\": needs the key \"over\""},
        BadFile{"TimeOfNoRate", "settle: 1.0", "events: [{at: 1, tau: 0.5, over: 1}]",
                ":19: key \"over\": goes with rate alone"},
        BadFile{"FigureOfAJointAtRest", "figure: E1", "figure: S1",
                ":20: key \"figure\": \"S1\", is moved by no primitive"},
        BadFile{"CameraFromAbove", "from: [1.55, -2.0, 1.0]", "from: [0.42, 0, 1.0]",
                ":21: key \"camera\": looks straight up or down"},
        BadFile{"TableBelowTheFloor", "figure: E1",
                "figure: E1\ntable: {at: [1, 0, 0], size: [1, 1]}",
                ":21: key \"at\": must be above the floor"},
        BadFile{"TableWithoutWidth", "figure: E1",
                "figure: E1\ntable: {at: [1, 0, 1], size: [1, 0]}",
                ":21: key \"size\": must be > 0"},
        BadFile{"NotFinite", "settle: 1.0", "settle: .inf",
                ":19: key \"settle\": \".inf\", must be a finite number"},
        BadFile{"FigureOfNoJoint", "figure: E1", "figure: E7", ":20: key \"figure\": "},
        BadFile{"NotYaml", "primitives:", "primitives: {", ":13: not YAML: "},
        BadFile{"AList", "sequence:\n", "sequence: [1]\nsettings:\n",
                ":10: key \"settings\": not known here"}),
    test::by_name);

TEST(Scene, IsReadWithSomeEntriesSetAnew) {
  const auto with = [](const std::vector<std::string>& overrides) {
    return Scene::read(line, overrides);
  };
  EXPECT_EQ(with({"dt=0.002"}).dt, 0.002);
  EXPECT_EQ(with({"title=Other", "title=Last"}).title, "Last");
  EXPECT_EQ(with({"robot.start.S1=0.25"}).start(0), 0.25);
  const Switch until = with({"sequence.steps.0.until={after: 0.5}"}).sequence.steps()[0].until;
  EXPECT_EQ(until.when, Switch::When::after);
  EXPECT_EQ(until.value, 0.5);
  EXPECT_EQ(with({"actuator.lag=0.002"}).actuator.lag(0), 0.002);
  const Scene fast = with({"speed=2"});
  EXPECT_EQ(fast.speed, 2.0);
  EXPECT_EQ(2.0 * fast.duration, with({}).duration);
  EXPECT_EQ(2.0 * fast.sequence.steps()[1].primitive.tau,
            with({}).sequence.steps()[1].primitive.tau);
}

struct BadOverride {
  const char* name;
  const char* text;
  const char* message;
};

class OverrideRefuses : public testing::TestWithParam<BadOverride> {};

TEST_P(OverrideRefuses, WithWhatIsWrong) {
  EXPECT_THAT(test::refusal([] { Scene::read(line, {GetParam().text}); }),
              HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    , OverrideRefuses,
    testing::Values(
        BadOverride{"NoValue", "dt", "dt: must be key=value"},
        BadOverride{"NoKey", "=1", "=1: must be key=value"},
        BadOverride{"EmptyPart", "robot..urdf=1", "robot..urdf=1: must be key=value"},
        BadOverride{"UnknownKey", "actuatr.lag=1", "line.yaml: key \"actuatr\": not known here"},
        BadOverride{"BadValue", "dt=-1", "line.yaml:18: key \"dt\": -1, must be > 0"},
        BadOverride{"NotANumber", "dt=nan", "key \"dt\": \"nan\", must be a finite number"},
        BadOverride{"NotYaml", "dt={", "dt={: the value is not YAML"},
        BadOverride{"ThroughAValue", "dt.x=1", "\"x\" is an entry of \"0.001\""},
        BadOverride{"BeyondTheList", "sequence.steps.2.play=up", "\"2\" is none of the list's"},
        BadOverride{"NoIndex", "sequence.steps.one.play=up", "must be 0 to 1"},
        BadOverride{"NoTime", "speed=0", "key \"speed\": 0, must be > 0"},
        BadOverride{"NoTimeAtAll", "speed=1e12", "key \"speed\": "}),
    test::by_name);

TEST(Scene, NamesFilesOfItsOwnFolderOfSeamsAssetsAndOfFoldersThatAreAllowed) {
  const TempFolder folder;
  const std::string scene = folder.write("mine/my.yaml", test::scene_text("line"));
  EXPECT_EQ(Scene::read(scene).robot.name, "pa10");
  folder.write("robots/arm.urdf", test::read_file(SEAM_TEST_DATA "/planar_arm.urdf"));
  const std::vector<std::string> other{"robot={urdf: ../robots/arm.urdf}"};
  EXPECT_EQ(test::refusal([&] { Scene::read(scene, other); }),
            scene +
                ":1: key \"urdf\": \"../robots/arm.urdf\" leads out of the file's folder, must be "
                "in it or below, or in a folder that is allowed (seam --allow DIR)");
  EXPECT_THAT(test::refusal([&] { Scene::read(scene, other, {folder.path("robots")}); }),
              HasSubstr("no joint \"E1\""));
}

TEST(Scene, AsksForNoMoreThanAMachineHas) {
  EXPECT_THAT(test::refusal([] {
                Scene::read(line, {"dt=1e-6", "settle=3600"});
              }),
              HasSubstr("more than 1e7 ticks"));
  EXPECT_THAT(test::refusal([] {
                Scene::read(line, {"events=[{from: 0, to: 10, every: 1.0e-4, goal: {E1: 1}}, "
                                   "{from: 0, to: 10, every: 1.0e-3, goal: {E1: 1}}]"});
              }),
              HasSubstr("more than 1e5 events"));
  EXPECT_THAT(test::refusal([] {
                Scene::read(SEAM_SCENES "/pouring.yaml", {"pouring.grains.count=100000"});
              }),
              HasSubstr("key \"count\": 100000, must be <= 1000"));
}

TEST(Scene, RefusesWhatIsNotAFile) {
  const TempFolder folder;
  EXPECT_THAT(test::refusal([&] { Scene::read(folder.path("none.yaml")); }),
              HasSubstr("cannot be read"));
  EXPECT_THAT(test::refusal([&] { Scene::read(folder.path("")); }), HasSubstr("is a folder"));
  EXPECT_THAT(test::refusal([&] { Scene::read(folder.write("empty.yaml", "")); }),
              HasSubstr("must be a map"));
}

}  // namespace
}  // namespace seam
