// The arm as it really is, in scenes: what every method must still do on the published PA-10, and how a scene says what its arm is.

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

class Published : public testing::TestWithParam<const char*> {};

// Masses 5 % off, 70 % of the friction known, drives that lag by 2 ms.
TEST_P(Published, PlaysToTheEndAndIsTracked) {
  Scene played = own_scene(GetParam(), {"arm=published"});
  if (played.pouring) played.pouring->places.resize(1);
  const std::vector<Join> methods(all_joins.begin(), all_joins.end());
  const auto quiet = [](int, int, const std::string&) {};
  const auto runs = compare({played}, methods, 2, quiet).front().runs;
  for (const seam::Run& run : runs) {
    SCOPED_TRACE(to_string(run.method));
    EXPECT_EQ(outcome(run.recording, "stopped_share"), 0.0);
    if (run.method == Join::dmp2) continue;
    EXPECT_LE(run.metrics.torque_jump_nm, 0.02 * runs[0].metrics.torque_jump_nm);
    // What is left of a jump where grains knock has no order.
    if (!played.pouring) {
      EXPECT_GE(run.metrics.torque_jump_order, 0.9);
    }
    EXPECT_EQ(outcome(run.recording, "limited_share"), 0.0);
    if (!played.tool) {
      EXPECT_LE(run.metrics.tracking_max_rad, 0.003);
      continue;
    }
    EXPECT_LE(run.metrics.tool_tracking_max_m, 0.003);
    EXPECT_LE(run.metrics.tool_tracking_rms_m, 0.001);
    EXPECT_LE(run.metrics.tool_tracking_max_rad, 0.015);
  }
}

INSTANTIATE_TEST_SUITE_P(, Published,
                         testing::Values("line", "wiping", "carrying", "catching", "through",
                                         "obstacle", "pouring"),
                         [](const auto& of) { return std::string(of.param); });

TEST(PublishedCarrying, SpillsWithDmp2AndNotWithTheOthers) {
  const Scene carrying = own_scene("carrying", {"arm=published"});
  for (const Join method : all_joins)
    EXPECT_EQ(outcome(play(carrying, method, carrying.dt), "spilled_share") > 0.0,
              method == Join::dmp2)
        << to_string(method);
}

// What the controller of old stopped at: friction that nobody told it of.
TEST(Arm, GoesOnWithFrictionThatItDoesNotKnow) {
  for (const char* friction :
       {"friction.coulomb=1", "friction.viscous=2",
        "friction.viscous={S1: 10, S2: 10, S3: 5, E1: 5, E2: 2, W1: 2, W2: 2}"}) {
    const Scene wiping = own_scene("wiping", {friction});
    EXPECT_EQ(play(wiping, Join::dmp3, wiping.dt).incident, "") << friction;
  }
}

// The published friction and rotors, all known: what is left is the sign of Coulomb's.
TEST(Arm, IsTrackedExactlyIfAllIsKnown) {
  const Scene known = own_scene("line", {"rotor_inertia={S1: 0.75, S2: 0.75, E1: 0.2125}",
                                         "friction.viscous=10", "known={friction: 1, rotors: 1}"});
  EXPECT_LT(measure(play(known, Join::dmp3, known.dt)).tracking_max_rad, 1e-9);
  const Scene unknown = own_scene("line", {"rotor_inertia={S1: 0.75, S2: 0.75, E1: 0.2125}"});
  EXPECT_GT(measure(play(unknown, Join::dmp3, unknown.dt)).tracking_max_rad, 1e-3);
}

// An observer on an ideal arm finds rounding.
TEST(Arm, IsTrackedAsWellWithAnObserverThatFindsNothing) {
  const Scene observed = own_scene("wiping", {"control.observer=60"});
  EXPECT_LT(measure(play(observed, Join::dmp3, observed.dt)).tool_tracking_max_m, 1e-9);
}

const char* const arm_urdf = R"(<robot name="r"><link name="base"/>
<link name="l"><inertial><origin xyz="0 0 0.2"/><mass value="1"/><inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j" type="revolute"><parent link="base"/><child link="l"/><axis xyz="0 1 0"/>
<limit lower="-3" upper="3" effort="100" velocity="5"/><dynamics damping="2" friction="0.5"/></joint></robot>)";

// A scene with a robot of its own in a folder of its own.
struct OwnArm : test::OneJoint {
  OwnArm() : OneJoint(arm_urdf) {}
  double error(const std::vector<std::string>& overrides = {}) const {
    const Scene played = read(overrides);
    return measure(play(played, Join::dmp3, played.dt)).tracking_max_rad;
  }
};

TEST(Arm, HasTheFrictionOfItsUrdfAndItsControllerKnowsIt) {
  const OwnArm own;
  EXPECT_EQ(own.read().simulated.joints[0].damping, 2.0);
  EXPECT_LT(own.error({"friction.coulomb=0", "known.friction=1"}), 1e-9);
  EXPECT_LT(own.error(), 0.02);
  EXPECT_GT(own.error({"known.friction=0"}), 0.03);
}

TEST(Arm, IsFoundByItsNameBesideTheUrdfAndTheSceneComesOnTop) {
  const OwnArm own;
  own.folder.write("worn.yaml",
                   "format: seam-arm 1\nfriction: {viscous: 7, coulomb: 3}\n"
                   "control: {observer: 40}\nactuator: {lag: 0.003, quantum: 0.1}\n");
  const Scene worn = own.read({"arm=worn", "friction.coulomb=1", "actuator.lag=0.001"});
  EXPECT_EQ(worn.arm, "worn");
  EXPECT_EQ(worn.simulated.joints[0].damping, 7.0);
  EXPECT_EQ(worn.simulated.joints[0].friction, 1.0);
  EXPECT_EQ(worn.robot.joints[0].damping, 2.0) << "the URDF's, since nothing is said to be known";
  EXPECT_EQ(worn.control.observer, 40.0);
  EXPECT_EQ(worn.actuator.lag(0), 0.001);
  EXPECT_EQ(worn.actuator.quantum(0), 0.1);
  own.folder.write("mine.yaml", "format: seam-arm 1\nrotor_inertia: 0.02\n");
  EXPECT_EQ(own.read({"arm=./mine.yaml"}).simulated.joints[0].rotor_inertia, 0.02);
  EXPECT_EQ(own.read({"arm=ideal"}).arm, "ideal");
}

TEST(Arm, IsRefusedWithFileLineAndKey) {
  const OwnArm own;
  const auto refused = [&](const std::vector<std::string>& overrides) {
    return test::refusal([&] { own.read(overrides); });
  };
  EXPECT_THAT(refused({"arm=odd"}), HasSubstr("key \"arm\": \"odd\", there is no "));
  own.folder.write("no-format.yaml", "friction: {viscous: 1}\n");
  EXPECT_THAT(refused({"arm=no-format"}), HasSubstr("no-format.yaml:1: needs the key \"format\""));
  own.folder.write("bad.yaml", "format: seam-arm 1\nfriction: {viscous: {k: 1}}\n");
  EXPECT_THAT(refused({"arm=bad"}), HasSubstr("bad.yaml:2: key \"k\": robot \"r\": no joint"));
  own.folder.write("sequence.yaml", "format: seam-arm 1\nsequence: {}\n");
  EXPECT_THAT(refused({"arm=sequence"}),
              HasSubstr("sequence.yaml:2: key \"sequence\": not known here"));
  EXPECT_THAT(refused({"arm=../elsewhere.yaml"}), HasSubstr("leads out of the file's folder"));
  EXPECT_THAT(refused({"elastic.stiffness=1000"}),
              HasSubstr("key \"elastic\": joint \"j\" needs a rotor_inertia > 0"));
  EXPECT_THAT(refused({"elastic.stiffness=0"}), HasSubstr("key \"stiffness\": 0, must be > 0"));
  EXPECT_THAT(refused({"rotor_inertia=-1"}), HasSubstr("key \"rotor_inertia\": -1, must be >= 0"));
  EXPECT_THAT(refused({"known.friction=-1"}), HasSubstr("key \"friction\": -1, must be >= 0"));
  EXPECT_THAT(refused({"known.payload=1"}), HasSubstr("key \"payload\": not known here"));
  EXPECT_THAT(refused({"control.observer=fast"}), HasSubstr("must be a finite number"));
  EXPECT_THAT(refused({"control.friction_velocity=0"}), HasSubstr("0, must be > 0"));
}

// The controller sees the motor, the recording has the link, which hangs by g·m·r/k from it.
TEST(Arm, WithASpringIsRecordedWhereTheLinkIs) {
  const OwnArm own;
  const auto off = [&](const char* encoders) {
    const Scene elastic =
        own.read({"rotor_inertia=0.05", "friction={coulomb: 0, viscous: 0}",
                  "elastic={stiffness: 500, damping: 1, encoders: " + std::string(encoders) + "}",
                  "settle=3"});
    const Recording played = play(elastic, Join::dmp2j, elastic.dt);
    EXPECT_EQ(played.incident, "");
    const Eigen::Index last = played.ticks() - 1;
    return std::pair(played.ref(last, 0) - played.q(last, 0), played.q(last, 0));
  };
  const auto [sag, q] = off("motor");
  EXPECT_NEAR(sag, -9.81 * 1.0 * 0.2 * std::sin(q) / 500.0, 5e-4);
  EXPECT_NEAR(off("link").first, 0.0, 5e-4);
}

}  // namespace
}  // namespace seam
