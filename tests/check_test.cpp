// What `seam check` finds out, and how it says it.

#include "bench/check.hpp"

#include <gmock/gmock.h>

#include "tests/refusals.hpp"
#include <seam/error.hpp>

namespace seam {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const std::string robots = SEAM_TEST_DATA "/robots/";

const Check& part(const RobotCheck& check, const std::string& name) {
  for (const Check& one : check.checks)
    if (one.name == name) return one;
  throw Error(name, "is not checked");
}

RobotCheck check(const RobotModel& model, int samples = 50) {
  return check_robot(model, {samples, 1});
}

TEST(CheckRobot, FindsNothingOddInThePa10) {
  const RobotCheck pa10 = check(RobotModel::read(SEAM_ASSETS "/pa10/pa10.urdf"));
  for (const Check& one : pa10.checks) EXPECT_THAT(one.oddities, IsEmpty()) << one.name;
  EXPECT_EQ(pa10.verdict(), Verdict::ok);
  EXPECT_LE(pa10.acceleration_error, 1e-9);
  EXPECT_GT(pa10.meshes.files().size(), 10U);
}

TEST(CheckRobot, FindsNothingOddInArmsOfOtherKinds) {
  for (const char* name : {"six_joint", "gripper_arm", "scara", "dummy_links"}) {
    const RobotCheck robot = check(RobotModel::read(robots + name + ".urdf"));
    for (const Check& one : robot.checks)
      EXPECT_THAT(one.oddities, IsEmpty()) << name << " " << one.name;
  }
}

// A rod of 2 kg on a prismatic joint along z and a turning one about y at its end, in closed form.
struct Rod : TempFolder {
  Rod() {
    file = write("rod.urdf", R"(<robot name="rod">
  <link name="base"/><link name="sledge"><inertial><mass value="3"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0.0008" ixy="0" ixz="0" iyy="0.1667" iyz="0" izz="0.1667"/></inertial>
    <collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.05 0.04"/></geometry></collision></link>
  <link name="tip"/>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="sledge"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.5" effort="60" velocity="1"/></joint>
  <joint name="swing" type="revolute"><parent link="sledge"/><child link="rod"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="12" velocity="2"/></joint>
  <joint name="to_tip" type="fixed"><parent link="rod"/><child link="tip"/><origin xyz="1 0 0"/></joint>
</robot>)");
  }
  RobotModel with(const std::string& from, const std::string& to) const {
    return RobotModel::read(write("other.urdf", test::replaced(test::read_file(file), from, to)));
  }
  std::string file;
};

TEST(CheckRobot, MeasuresARodAsTheClosedFormsSay) {
  const RobotCheck rod = check(RobotModel::read(Rod().file), 2000);
  EXPECT_NEAR(rod.holding(0), 5.0 * 9.81, 1e-12);
  EXPECT_LE(rod.holding(1), 2.0 * 9.81 * 0.5);
  EXPECT_NEAR(rod.holding(1), 2.0 * 9.81 * 0.5, 1e-3);
  EXPECT_EQ(rod.tip, "tip");
  EXPECT_LE(rod.reach, 1.5);
  EXPECT_NEAR(rod.reach, 1.5, 0.05);
  EXPECT_NEAR(rod.reached.min().x(), -1.0, 0.02);
  EXPECT_NEAR(rod.reached.max().z(), 1.5, 0.05);
  EXPECT_NEAR(rod.bodies[1].density, 2.0 / (0.05 * 0.04), 1e-9);
  EXPECT_NEAR(rod.bodies[1].gyration(2), std::sqrt(0.1667 / 2.0), 1e-12);
  EXPECT_NEAR(rod.bodies[1].reach, Eigen::Vector3d(0.5, 0.025, 0.02).norm(), 1e-12);
}

TEST(CheckRobot, NamesWhatLooksWrong) {
  const Rod rod;
  const auto oddities = [&](const std::string& name, const std::string& from,
                            const std::string& to) {
    const RobotCheck robot = check(rod.with(from, to));
    EXPECT_EQ(part(robot, name).verdict, Verdict::warning) << name;
    EXPECT_EQ(robot.verdict(), Verdict::warning) << name;
    return part(robot, name).oddities;
  };
  EXPECT_THAT(oddities("holding", R"(effort="12")", R"(effort="9")"),
              Contains(HasSubstr(R"(joint "swing": up to 9.8)")));
  EXPECT_THAT(oddities("limits", R"(effort="12")", R"(effort="0")"),
              Contains(R"(joint "swing": effort limit 0)"));
  EXPECT_THAT(oddities("limits", R"(velocity="2")", R"(velocity="0")"),
              Contains(R"(joint "swing": velocity limit 0)"));
  EXPECT_THAT(oddities("limits", R"(lower="-3" upper="3")", ""),
              Contains(HasSubstr("lower and upper limit are both 0")));
  EXPECT_THAT(oddities("URDF", R"(<link name="base"/>)",
                       R"(<link name="base"><inertial><mass value="0"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>)"),
              Contains(R"(link "base": its mass is 0, its inertia not: taken for none)"));
  EXPECT_THAT(oddities("inertia", R"(iyy="0.1667" iyz="0" izz="0.1667")",
                       R"(iyy="0.001" iyz="0" izz="0.001")"),
              Contains(HasSubstr(R"(link "rod": radius of gyration 0.0224 m)")));
  EXPECT_THAT(oddities("URDF", R"(izz="0.1667")", R"(izz="0.171")"),
              Contains(HasSubstr("the largest exceeds the sum of the others by 2.08955 %")));
  EXPECT_THAT(
      oddities("inertia", R"(<origin xyz="0.5 0 0"/><mass)", R"(<origin xyz="1.5 0 0"/><mass)"),
      Contains(R"(link "rod": centre of mass 0.5 m outside its shape)"));
  EXPECT_THAT(oddities("inertia", R"(1 0.05 0.04)", R"(1 0.005 0.004)"),
              Contains(R"(link "rod": 2 kg in its shape are 1e+05 kg/m³)"));
}

TEST(CheckRobot, NamesAFollowerThatItsLeaderTakesBeyondItsLimits) {
  RobotModel model = RobotModel::read(robots + "gripper_arm.urdf");
  model.joints[static_cast<std::size_t>(model.joint("grip_right"))].upper = 0.03;
  EXPECT_THAT(part(check(model), "limits").oddities,
              testing::ElementsAre(R"(joint "grip_right": "grip" takes it beyond its limits)"));
}

TEST(CheckRobot, FailsForMeshesThatAreMissingOrCannotBeRead) {
  const Rod rod;
  const std::string box = R"(<box size="1 0.05 0.04"/>)";
  UrdfSettings lenient;
  lenient.leave_out_missing_meshes = true;
  const std::string missing = rod.write(
      "m.urdf", test::replaced(test::read_file(rod.file), box, R"(<mesh filename="no.stl"/>)"));
  const RobotCheck one = check(RobotModel::read(missing, lenient));
  EXPECT_EQ(one.verdict(), Verdict::failed);
  EXPECT_THAT(part(one, "meshes").oddities, Contains(HasSubstr(R"(mesh "no.stl" not found)")));
  rod.write("bad.obj", "v 0 0 nonsense\n");
  const RobotCheck other = check(rod.with(box, R"(<mesh filename="bad.obj"/>)"));
  EXPECT_EQ(part(other, "meshes").verdict, Verdict::failed);
  EXPECT_THAT(part(other, "meshes").oddities, Contains(HasSubstr("bad.obj: ")));
}

TEST(CheckCommand, PrintsOnePage) {
  const test::Outcome outcome = test::run("check " + robots + "gripper_arm.urdf");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(
      outcome.output,
      AllOf(StartsWith("gripper_arm ("), HasSubstr("): 10 joints, 13 links, 16.59 kg move\n"),
            HasSubstr("-15 grip +0.2 |"), HasSubstr("| prismatic | link_a7 → left_finger"),
            HasSubstr("0 to 0.04 m"), HasSubstr("dynamics Bullet makes accelerations"),
            HasSubstr("reach    link \"right_pad\" comes ")));
  EXPECT_THAT(outcome.output, Not(HasSubstr("FAILED")));
  EXPECT_LE(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 50);
}

TEST(CheckCommand, ListsWhatIsOddAboutAUrdfAndShowsDampingAndFriction) {
  const test::Outcome outcome = test::run("check " + robots + "odd_arm.urdf");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(
      outcome.output,
      AllOf(
          HasSubstr("| 0.5 N·m·s/rad |  0.25 N·m |"), HasSubstr("|      20 N·s/m |       0 N |"),
          HasSubstr("| slide    | prismatic  | lower → hand  | 0 to 0.1 m                         "
                    "|    none |"),
          HasSubstr("URDF     10 to look at: warning\n"),
          HasSubstr("- joint \"grip\": moves nothing with mass: held at 0.01 m\n"),
          HasSubstr("- link \"upper\": visual: sphere of radius 0 m, must be > 0: left out\n")));
  EXPECT_THAT(outcome.output, Not(HasSubstr("FAILED")));
}

TEST(CheckRobot, ComparesDynamicsWithTheLargestAcceleration) {
  const RobotCheck points = check(RobotModel::read(robots + "point_masses.urdf"), 100);
  EXPECT_LE(points.acceleration_error, 1e-7 * points.largest_acceleration);
  EXPECT_GT(points.largest_acceleration, 29.0);
  EXPECT_LE(points.largest_acceleration, 30.0);
  EXPECT_EQ(part(points, "dynamics").verdict, Verdict::ok);
  const RobotCheck still =
      check(RobotModel::read(Rod().write("x.urdf", "<robot><link name='a'/></robot>")));
  EXPECT_EQ(part(still, "dynamics").verdict, Verdict::ok);
}

TEST(CheckRobot, TakesAJointThatSlidesWithoutEndForOneOfAMetre) {
  const RobotCheck rod = check(Rod().with(R"(lower="0" upper="0.5")", R"(lower="1" upper="0")"));
  EXPECT_EQ(part(rod, "dynamics").verdict, Verdict::ok);
  EXPECT_NEAR(rod.reached.max().z(), 1.9, 0.2);
}

TEST(CheckCommand, GivesTheSameBytesForTheSameSeed) {
  const std::string call = "check " + robots + "scara.urdf --samples 100 --seed ";
  EXPECT_EQ(test::run(call + "7").output, test::run(call + "7").output);
  EXPECT_NE(test::run(call + "7").output, test::run(call + "8").output);
}

TEST(CheckCommand, FailsWithCodeOneAndGoesOnWhereAMeshIsMissing) {
  const Rod rod;
  const std::string mesh = R"(<mesh filename="package://arm/rod.obj"/>)";
  const std::string file = rod.write(
      "m.urdf", test::replaced(test::read_file(rod.file), R"(<box size="1 0.05 0.04"/>)", mesh));
  const test::Outcome missing = test::run("check " + file);
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.output, AllOf(HasSubstr("meshes   0 files read, 0 triangles: FAILED\n"),
                                    HasSubstr("mesh \"package://arm/rod.obj\" not found")));
  rod.write("packages/arm/rod.obj", test::read_file(SEAM_TEST_DATA "/block.obj"));
  const test::Outcome found =
      test::run("check " + file + " --package-path " + rod.path("packages"));
  EXPECT_THAT(found.output, HasSubstr("meshes   1 files read, 12 triangles: ok\n"));
}

TEST(CheckCommand, RefusesWhatIsNoRobotInOneLine) {
  const TempFolder folder;
  folder.write("x.urdf", "<robot name='r' xmlns:xacro='x'><xacro:macro/></robot>");
  folder.write("empty.urdf", "");
  const auto mass = [](const std::string& value) {
    return "<robot name='r'><link name='a'><inertial><mass value='" + value +
           "'/></inertial></link></robot>";
  };
  folder.write("nan.urdf", mass("nan"));
  folder.write("huge.urdf", mass("1e300"));
  folder.write("loop.urdf",
               "<robot name='r'><link name='a'/><link name='b'/>"
               "<joint name='i' type='fixed'><parent link='a'/><child link='b'/></joint>"
               "<joint name='j' type='fixed'><parent link='b'/><child link='a'/></joint></robot>");
  for (const test::BadCall& bad :
       {test::BadCall{"NoFile", "check @none.urdf", "none.urdf: no such file"},
        {"Xacro", "check @x.urdf", "must be expanded first"},
        {"Empty", "check @empty.urdf", "is empty"},
        {"MassNan", "check @nan.urdf", "mass [nan] is not a float"},
        {"Loop", "check @loop.urdf", "is its own ancestor, must be in a tree"},
        {"Huge", "check @huge.urdf", "mass 1e+300 kg, must be at most 1e+15 in magnitude"},
        {"NoSamples", "check @x.urdf --samples 0", "--samples"},
        {"Nothing", "check", "robot is required"}})
    test::expect_refused(bad, folder);
}

}  // namespace
}  // namespace seam
