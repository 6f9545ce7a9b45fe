#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "tests/temp_folder.hpp"
#include <seam/error.hpp>
#include <seam/robot_model.hpp>

namespace {

using Eigen::Vector3d;
using seam::RobotModel;

constexpr double infinity = std::numeric_limits<double>::infinity();

const char* const mass =
    R"(<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)";

std::string robot(const std::string& content) {
  return R"(<robot name="r">)" + content + "</robot>";
}

std::string link(const std::string& name, const std::string& content = mass) {
  return R"(<link name=")" + name + R"(">)" + content + "</link>";
}

std::string joint(
    const std::string& name, const std::string& type, const std::string& parent,
    const std::string& child,
    const std::string& content = R"(<limit lower="-1" upper="1" effort="5" velocity="2"/>)") {
  return R"(<joint name=")" + name + R"(" type=")" + type + R"("><parent link=")" + parent +
         R"("/><child link=")" + child + R"("/>)" + content + "</joint>";
}

/// A base `a` and a link `b` behind the joint `j`.
std::string one_joint(const std::string& content, const std::string& type = "revolute") {
  return robot(link("a") + link("b") + joint("j", type, "a", "b", content));
}

/// A chain of links `a` to `d` with the joints `i`, `j` and `k`, of which each may have more to it.
std::string three_joints(const std::string& i, const std::string& j, const std::string& k) {
  const std::string limit = R"(<limit lower="-1" upper="1" effort="5" velocity="2"/>)";
  return robot(
      link("a") + link("b") + link("c") + link("d") + joint("i", "revolute", "a", "b", limit + i) +
      joint("j", "revolute", "b", "c", limit + j) + joint("k", "revolute", "c", "d", limit + k));
}

std::string inertial_element(const std::string& mass_value, const std::string& ixx,
                             const std::string& iyy, const std::string& izz) {
  return R"(<inertial><mass value=")" + mass_value + R"("/><inertia ixx=")" + ixx +
         R"(" ixy="0" ixz="0" iyy=")" + iyy + R"(" iyz="0" izz=")" + izz + R"("/></inertial>)";
}

/// A link `a` whose inertial element says this.
std::string inertial(const std::string& mass_value, const std::string& ixx, const std::string& iyy,
                     const std::string& izz) {
  return robot(link("a", inertial_element(mass_value, ixx, iyy, izz)));
}

std::string shape(const std::string& kind, const std::string& geometry) {
  return robot(link("a", "<" + kind + "><geometry>" + geometry + "</geometry></" + kind + ">"));
}

using Lines = std::vector<std::string>;

RobotModel read(const std::string& text, const std::vector<std::string>& package_path = {}) {
  const TempFolder folder;
  return RobotModel::read(folder.write("x.urdf", text), {package_path});
}

/// The message of the refusal, with the test's own folder taken off.
std::string refusal(const std::string& text) {
  const TempFolder folder;
  std::string message = "accepted";
  try {
    RobotModel::read(folder.write("x.urdf", text));
  } catch (const seam::Error& error) {
    message = error.what();
  }
  for (std::size_t at; (at = message.find(folder.path(""))) != std::string::npos;) {
    message.erase(at, folder.path("").size());
  }
  return message;
}

struct Refused {
  const char* name;
  std::string text;
  std::string message;
};
std::ostream& operator<<(std::ostream& out, const Refused& refused) {
  return out << refused.name;
}

class RobotModelRefuses : public testing::TestWithParam<Refused> {};

TEST_P(RobotModelRefuses, InOneLineThatSaysWhy) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

const char* const limits = R"(<limit lower="-1" upper="1" effort="5" velocity="2"/>)";

const Refused refusals[] = {
    {"EmptyFile", "  \n", "x.urdf: is empty"},
    {"NotXml", "<robot name='r'>\n<link name='a'>\n</robot>",
     "x.urdf:2: not well-formed XML (XML_ERROR_MISMATCHED_ELEMENT)"},
    {"NoXmlAtAll", "mass: 3", "x.urdf:1: not well-formed XML (XML_ERROR_PARSING_TEXT)"},
    {"OtherRoot", "<sdf/>", "x.urdf: root element is <sdf>, must be <robot>"},
    {"NoNameAndNoLink", "<robot/>", "x.urdf: No link elements found in urdf file"},
    {"NoLink", robot(""), "x.urdf: No link elements found in urdf file"},
    {"LinkTwice", robot(link("a") + link("a")), "x.urdf: link 'a' is not unique."},
    {"TwoRoots", robot(link("a") + link("b")),
     "x.urdf: Failed to find root link: Two root links found: [a] and [b]"},
    {"Xacro",
     "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>\n<link name='a'/>\n"
     "<xacro:include filename='x'/>\n</robot>",
     "x.urdf:3: <xacro:include> is xacro, must be expanded first: xacro in.xacro > out.urdf"},
    {"JointToNowhere", robot(link("a") + joint("j", "fixed", "a", "b")),
     "x.urdf: Failed to build tree: child link [b] of joint [j] not found"},
    {"NoRootElement", "<!-- nothing -->", "x.urdf: root element is <>, must be <robot>"},
    {"Ring", robot(link("a") + joint("j", "fixed", "a", "a")),
     R"(x.urdf: link "a": is its own ancestor, must be in a tree)"},
    {"RingAside",
     robot(link("a") + link("b") + link("c") + joint("j", "fixed", "b", "c") +
           joint("k", "fixed", "c", "b")),
     R"(x.urdf: link "c": is its own ancestor, must be in a tree)"},
    {"TwoParents",
     robot(link("a") + link("b") + link("c") + joint("i", "fixed", "a", "b") +
           joint("j", "fixed", "a", "c") + joint("k", "fixed", "b", "c")),
     R"(x.urdf: link "c": is the child of joints "j" and "k", must be of one)"},
    {"JointWithoutChild",
     robot(link("a") + R"(<joint name="j" type="fixed"><parent link="a"/></joint>)"),
     "x.urdf: Failed to build tree: Joint [j] is missing a parent and/or child link "
     "specification."},

    {"MassNan", inertial("nan", "1", "1", "1"),
     "x.urdf: Inertial: mass [nan] is not a float; Could not parse inertial element for Link [a]"},
    {"MassInfinite", inertial("inf", "1", "1", "1"),
     "x.urdf: Inertial: mass [inf] is not a float; Could not parse inertial element for Link [a]"},
    {"MassTooLarge", inertial("1e999", "1", "1", "1"),
     "x.urdf: Inertial: mass [1e999] is not a float; Could not parse inertial element for Link "
     "[a]"},
    {"MassWithComma", inertial("1,5", "1", "1", "1"),
     "x.urdf: Inertial: mass [1,5] is not a float; Could not parse inertial element for Link [a]"},
    {"MassIsAFormat", inertial("%n", "1", "1", "1"),
     R"(x.urdf:1: <mass value="%n">, must not contain %)"},
    {"NameIsAFormat", robot(link("%s")), R"(x.urdf:1: <link name="%s">, must not contain %)"},
    {"MassMissing", robot(link("a", "<inertial/>")),
     "x.urdf: Inertial element must have a mass element; Could not parse inertial element for Link "
     "[a]"},
    {"InertiaNan", inertial("1", "nan", "1", "1"),
     "x.urdf: Inertial: inertia element ixx is not a valid double; Could not parse inertial "
     "element for Link [a]"},
    {"OriginNan",
     robot(link(
         "a",
         R"(<visual><origin xyz="0 nan 0"/><geometry><sphere radius="1"/></geometry></visual>)")),
     "x.urdf: Unable to parse component [nan] to a double (while parsing a vector value); Could "
     "not parse visual element for "
     "Link [a]"},

    {"TwoJointsOnOneAxisWithoutMassBetween",
     robot(link("a") + link("b", "") + link("c") + joint("j", "revolute", "a", "b") +
           joint("k", "revolute", "b", "c")),
     R"(x.urdf: link "b": has no mass, nor has any link fixed to it, but joint "j" moves it, and )"
     "nothing behind it resists: must be > 0"},
    {"MovingMassNegative",
     robot(link("a") + link("b", inertial_element("-1", "1", "1", "1")) +
           joint("j", "revolute", "a", "b")),
     R"(x.urdf: link "b": mass -1 kg, with what is fixed to it, must be > 0)"},
    {"MovingMassesCancel",
     robot(link("a") + link("b") + link("c", inertial_element("-1", "1", "1", "1")) +
           joint("j", "revolute", "a", "b") + joint("k", "fixed", "b", "c", "")),
     R"(x.urdf: link "b": mass 0 kg, with what is fixed to it, must be > 0)"},
    {"MovingMomentNegative",
     robot(link("a") + link("b", inertial_element("1", "-0.1", "1", "1")) +
           joint("j", "revolute", "a", "b")),
     R"(x.urdf: link "b": has the principal moments of inertia -0.1, 1, 1 kg m^2, with what is )"
     R"(fixed to it, but joint "j" moves it, and nothing behind it resists: must be > 0)"},
    {"MassHuge", inertial("1e300", "1", "1", "1"),
     R"(x.urdf: link "a": mass 1e+300 kg, must be at most 1e+15 in magnitude)"},
    {"MomentHuge", inertial("1", "1e300", "1e300", "1e300"),
     R"(x.urdf: link "a": moment of inertia 1e+300 kg m^2, must be at most 1e+15 in magnitude)"},
    {"LinkFarAway",
     robot(link("a") + link("b") + joint("j", "fixed", "a", "b", R"(<origin xyz="1e300 0 0"/>)")),
     R"(x.urdf: joint "j": is more than 1e+09 m from the joint before)"},
    {"MassFarAway",
     robot(link("a") + link("b", R"(<inertial><origin xyz="0 1e300 0"/><mass value="1"/>
             <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)") +
           joint("j", "revolute", "a", "b")),
     R"(x.urdf: link "b": its centre of mass is more than 1e+09 m from its joint)"},
    {"JointFarAway", one_joint(std::string(limits) + R"(<origin xyz="0 0 1e300"/>)"),
     R"(x.urdf: joint "j": is more than 1e+09 m from the joint before)"},
    {"InertiaTooSmallForBullet",
     robot(link("a") + link("b", inertial_element("1e-14", "1e-20", "1e-20", "1e-20")) +
           joint("j", "revolute", "a", "b")),
     R"(x.urdf: joint "j": moves an inertia of 3e-20 kg m^2, must be > 1e-15)"},
    {"LimitsFarAway", one_joint(R"(<limit lower="1e300" upper="2e300" effort="1" velocity="1"/>)"),
     R"(x.urdf: joint "j": lower limit 1e+300 rad, must be at most 1e+09 in magnitude)"},
    {"MimicByAHugeNumber", three_joints(R"(<mimic joint="j" multiplier="1e300"/>)", "", ""),
     R"(x.urdf: joint "i": mimics by 1e+300, must be at most 1e+09 in magnitude)"},

    {"Helical", one_joint("", "helical"),
     "x.urdf: Joint [j] has no known type [helical]; joint xml is not initialized correctly"},
    {"MimicOfNoName", one_joint(std::string(limits) + "<mimic/>"),
     "x.urdf: joint mimic: no mimic joint specified; Could not parse mimic element for joint  [j]; "
     "joint xml is not initialized correctly"},
    {"MimicByNoNumber", one_joint(std::string(limits) + R"(<mimic joint="j" multiplier="nan"/>)"),
     "x.urdf: multiplier value (nan) is not a valid float; Could not parse mimic element for joint "
     " "
     "[j]; joint xml is not initialized correctly"},
    {"AxisTooSmall", one_joint(std::string(limits) + R"(<axis xyz="1e-308 0 0"/>)"),
     R"(x.urdf: joint "j": axis 1e-308 0 0, must not be zero)"},
    {"AxisZero", one_joint(std::string(limits) + R"(<axis xyz="0 0 0"/>)"),
     R"(x.urdf: joint "j": axis 0 0 0, must not be zero)"},
    {"AxisWithoutXyz", one_joint(std::string(limits) + "<axis/>"),
     R"(x.urdf: joint "j": axis 0 0 0, must not be zero)"},

    {"MeshMissing", shape("visual", R"(<mesh filename="no.obj"/>)"),
     R"(x.urdf: link "a": visual: mesh "no.obj" not found, looked for no.obj)"},
    {"MeshWithoutPackage", shape("visual", R"(<mesh filename="package://none/no.obj"/>)"),
     R"(x.urdf: link "a": visual: mesh "package://none/no.obj" not found, no folder to look in: give one that is or holds )"
     R"(package "none" in package_path or ROS_PACKAGE_PATH)"},
    {"MeshFromTheNet", shape("visual", R"(<mesh filename="http://x/no.obj"/>)"),
     R"(x.urdf: link "a": visual: mesh "http://x/no.obj" not found, must be package://, file:// or )"
     "a path"},
    {"MeshOfTwoLines", shape("visual", "<mesh filename=\"a&#10;b\"/>"),
     R"(x.urdf: link "a": visual: mesh "a b" not found, looked for a b)"},
    {"MeshIsAFolder", shape("visual", R"(<mesh filename="."/>)"),
     R"(x.urdf: link "a": visual: mesh "." not found, looked for )"},
};

INSTANTIATE_TEST_SUITE_P(Urdf, RobotModelRefuses, testing::ValuesIn(refusals),
                         [](const auto& refused) { return refused.param.name; });

struct Warned {
  const char* name;
  std::string text;
  std::vector<std::string> warnings;
};
std::ostream& operator<<(std::ostream& out, const Warned& warned) {
  return out << warned.name;
}

class RobotModelWarns : public testing::TestWithParam<Warned> {};

TEST_P(RobotModelWarns, AboutWhatIsOddAndSaysWhatItDid) {
  EXPECT_EQ(read(GetParam().text).warnings, GetParam().warnings);
}

std::string visual(const std::string& geometry) {
  return shape("visual", geometry);
}

const Warned warnings[] = {
    {"Nothing", one_joint(limits), {}},
    {"NoName", "<robot>" + link("a") + "</robot>", {R"(robot: has no name: called "x")"}},
    {"NameOfTwoLines",
     robot(link("a&#10;b", inertial_element("0", "1", "1", "1"))),
     {R"(link "a b": its mass is 0, its inertia not: taken for none)"}},

    {"MassNegativeOfTheBase",
     inertial("-1", "1", "1", "1"),
     {R"(link "a": mass -1 kg, must be >= 0: counted as it is, with what it is fixed to)"}},
    {"MassOfRounding",
     inertial("-1e-18", "1", "1", "1"),
     {R"(link "a": mass -1e-18 kg: taken for none)"}},
    {"InertiaMissing",
     robot(link("a", R"(<inertial><mass value="1"/></inertial>)")),
     {R"(link "a": has no inertia: taken for a point)"}},
    {"ProductsMissing",
     robot(
         link("a", R"(<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>)")),
     {R"(link "a": inertia without ixy: taken for 0)",
      R"(link "a": inertia without ixz: taken for 0)",
      R"(link "a": inertia without iyz: taken for 0)"}},
    {"MomentNegativeOfTheBase",
     inertial("1", "-0.1", "1", "1"),
     {R"(link "a": inertia has the principal moments -0.1, 1, 1 kg m^2, must all be > 0: counted )"
      "as it is, with what it is fixed to"}},
    {"MomentZero",
     inertial("1", "0", "1", "1"),
     {R"(link "a": inertia has the principal moments 0, 1, 1 kg m^2, must all be > 0: taken for 0 )"
      "where they are 0 but for rounding"}},
    {"TriangleRule",
     inertial("1", "0.1", "0.5", "0.2"),
     {R"(link "a": inertia has the principal moments 0.1, 0.2, 0.5 kg m^2, the largest exceeds the )"
      "sum of the others by 66.6667 %, which no body's does: used as it is"}},
    // Roll, pitch, roll: where the pitch is 0 both rolls turn the last link alone.
    {"GimbalWithoutMass",
     robot(link("a") + link("b", "") + link("c", "") + link("d") +
           joint("j", "revolute", "a", "b") +
           joint("k", "revolute", "b", "c", std::string(limits) + R"(<axis xyz="0 1 0"/>)") +
           joint("l", "revolute", "c", "d")),
     {R"(link "b": has no mass, nor has any link fixed to it, and in some positions nothing behind )"
      R"(it resists joint "j": accelerations have no bound there)"}},

    {"MovesWithoutMass",
     robot(link("a") + link("b", "") + link("c", "") +
           joint("j", "revolute", "a", "b",
                 R"(<limit lower="0.5" upper="1" effort="1" velocity="1"/>)") +
           joint("k", "prismatic", "b", "c")),
     {R"(joint "j": moves nothing with mass: held at 0.5 rad)",
      R"(joint "k": moves nothing with mass: held at 0 m)"}},
    {"Spherical",
     one_joint("", "spherical"),
     {R"(joint "j": is spherical, seam's joints have one degree of freedom: held where it is)"}},
    {"Floating",
     one_joint("", "floating"),
     {R"(joint "j": is floating, seam's joints have one degree of freedom: held where it is)"}},
    {"Planar",
     one_joint("", "planar"),
     {R"(joint "j": is planar, seam's joints have one degree of freedom: held where it is)"}},

    {"MimicOfItself",
     one_joint(std::string(limits) + R"(<mimic joint="j"/>)"),
     {R"(joint "j": mimics itself: follows none)"}},
    {"MimicsInARing",
     three_joints(R"(<mimic joint="k"/>)", R"(<mimic joint="i"/>)", R"(<mimic joint="j"/>)"),
     {R"(joint "i": mimics itself: follows none)", R"(joint "j": mimics itself: follows none)",
      R"(joint "k": mimics itself: follows none)"}},
    {"MimicOfNone",
     one_joint(std::string(limits) + R"(<mimic joint="i"/>)"),
     {R"(joint "j": mimics joint "i", which is not there: follows none)"}},
    {"MimicOfAFixedJoint",
     robot(link("a") + link("b") + link("c") +
           joint("i", "fixed", "a", "b", R"(<mimic joint="j"/>)") +
           joint("j", "revolute", "b", "c", std::string(limits) + R"(<mimic joint="i"/>)")),
     {R"(joint "j": mimics joint "i", which does not move: follows none)"}},

    {"LimitMissing", one_joint(""), {R"(joint "j": has no <limit>: moves without limits)"}},
    {"EffortMissing",
     one_joint(R"(<limit velocity="1"/>)"),
     {R"(joint "j": has no effort limit: taken for none)"}},
    {"SpeedMissing",
     one_joint(R"(<limit effort="1"/>)"),
     {R"(joint "j": has no velocity limit: taken for none)"}},
    {"EffortNegative",
     one_joint(R"(<limit effort="-1" velocity="1"/>)"),
     {R"(joint "j": effort limit -1 N m, must be >= 0: taken for none)"}},
    {"SpeedNegative",
     one_joint(R"(<limit effort="1" velocity="-0.5"/>)", "prismatic"),
     {R"(joint "j": velocity limit -0.5 m/s, must be >= 0: taken for none)"}},
    {"LimitsCrossed",
     one_joint(R"(<limit lower="1" upper="0.5" effort="1" velocity="1"/>)"),
     {R"(joint "j": lower limit 1 rad is above the upper limit 0.5 rad: taken for none, as in )"
      "Bullet"}},
    {"DynamicsNegative",
     one_joint(std::string(limits) + R"(<dynamics damping="-1" friction="-0.5"/>)"),
     {R"(joint "j": damping -1, must be >= 0: taken for 0)",
      R"(joint "j": friction -0.5, must be >= 0: taken for 0)"}},
    {"OriginOfFourNumbers",
     one_joint(std::string(limits) + R"(<origin rpy="0 1 0 9"/>)"),
     {R"(joint "j": rpy "0 1 0 9", must be 3 numbers: the first 3 count)"}},

    {"Capsule",
     shape("collision", R"(<capsule radius="1" length="1"/>)"),
     {R"(link "a": collision: <capsule>, which URDF lacks: taken for Bullet's, along z)"}},
    {"Plane",
     shape("collision", R"(<plane normal="0 0 1"/>)"),
     {R"(link "a": collision: <plane>, which URDF lacks: left out)"}},
    {"NoGeometry", robot(link("a", "<visual/>")), {R"(link "a": visual: has no shape: left out)"}},
    {"MeshWithoutFile",
     visual("<mesh/>"),
     {R"(link "a": visual: mesh without a file name: left out)"}},
    {"BoxFlat",
     shape("collision", R"(<box size="1 0 1"/>)"),
     {R"(link "a": collision: box of size 1 0 1 m, must all be > 0: left out)"}},
    {"CylinderThin",
     visual(R"(<cylinder radius="0" length="1"/>)"),
     {R"(link "a": visual: cylinder of radius 0 m and length 1 m, must be > 0: left out)"}},
    {"SphereOfNoSize",
     visual(R"(<sphere radius="0"/>)"),
     {R"(link "a": visual: sphere of radius 0 m, must be > 0: left out)"}},
    {"MeshWithoutScale",
     visual(R"(<mesh filename="x.urdf" scale="1 0 1"/>)"),
     {R"(link "a": visual: mesh "x.urdf" of scale 1 0 1, must not be 0: left out)"}},
    {"ScaleOfFourNumbers",
     visual(R"(<mesh filename="x.urdf" scale="1 2 3 1"/>)"),
     {R"(link "a": scale "1 2 3 1", must be 3 numbers: the first 3 count)"}},
    {"ScaleOfOneNumber",
     visual(R"(<mesh filename="x.urdf" scale="2"/>)"),
     {R"(link "a": scale "2", must be 3 numbers: taken for all axes)"}},

    {"MaterialTwice",
     robot(R"(<material name="m"><color rgba="1 0 0 1"/></material>)"
           R"(<material name="m"><color rgba="0 1 0 1"/></material>)" +
           link("a")),
     {R"(material "m": is given twice: the first one counts)"}},
    {"MaterialSaysNothing",
     robot(R"(<material name="m"/>)" + link("a")),
     {R"(material "m": has neither colour nor texture: left out)"}},
    {"ColourOfThreeNumbers",
     robot(R"(<material name="m"><color rgba="1 0 0"/></material>)" + link("a")),
     {R"(material "m": rgba "1 0 0", must be 4 numbers: taken for opaque)"}},
};

INSTANTIATE_TEST_SUITE_P(Urdf, RobotModelWarns, testing::ValuesIn(warnings),
                         [](const auto& warned) { return warned.param.name; });

std::string refusal_of_path(const std::string& path) {
  try {
    RobotModel::read(path);
  } catch (const seam::Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RobotModel, RefusesWhatIsNotAFile) {
  const TempFolder folder;
  EXPECT_EQ(refusal_of_path("/no/such.urdf"), "/no/such.urdf: no such file");
  EXPECT_EQ(refusal_of_path(folder.path("")),
            folder.path("") + ": is a folder, must be a URDF file");
}

TEST(RobotModel, PrintsNothingWhenItRefuses) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  refusal(robot(""));
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(RobotModel, ReadsThePa10) {
  const auto model = RobotModel::read(SEAM_ASSETS "/pa10/pa10.urdf");
  const std::vector<std::string> names = {"S1", "S2", "S3", "E1", "E2", "W1", "W2"};
  ASSERT_EQ(model.dof(), 7);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(model.joint(names[static_cast<std::size_t>(i)]), i);
    EXPECT_EQ(model.joints[static_cast<std::size_t>(i)].parent, i - 1);
  }
}

TEST(RobotModel, NumbersBranchesAsTheFileDoes) {
  const auto model =
      read(robot(link("a") + link("b") + link("c") + link("d") + joint("z", "revolute", "a", "b") +
                 joint("m", "revolute", "a", "c") + joint("k", "revolute", "b", "d")));
  EXPECT_EQ(model.joint("z"), 0);
  EXPECT_EQ(model.joint("k"), 1);
  EXPECT_EQ(model.joint("m"), 2);
  EXPECT_EQ(model.joints[1].parent, 0);
  EXPECT_EQ(model.joints[2].parent, -1);
}

TEST(RobotModel, NamesWhatThereIsWhenAskedForWhatIsNot) {
  const auto model = RobotModel::read(SEAM_TEST_DATA "/planar_arm.urdf");
  try {
    model.joint("wrist");
    FAIL();
  } catch (const seam::Error& error) {
    EXPECT_STREQ(error.what(), R"(robot "planar_arm": no joint "wrist", it has shoulder elbow)");
  }
  try {
    model.frame("hand");
    FAIL();
  } catch (const seam::Error& error) {
    EXPECT_STREQ(error.what(),
                 R"(robot "planar_arm": no link "hand", it has base upper lower tool)");
  }
}

// Two spheres of 2 kg, 0.1 kg m² each, 1 m apart on x: the pair has 2·(0.1 + 2·0.5²) about y and z.
TEST(RobotModel, MergesFixedLinksByTheParallelAxisTheorem) {
  const std::string ball =
      R"(<inertial><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>)";
  const auto model =
      read(robot(link("a") + link("b", ball) + link("c", ball) + joint("j", "revolute", "a", "b") +
                 joint("k", "fixed", "b", "c", R"(<origin xyz="1 0 0" rpy="0.3 0.2 0.1"/>)")));
  ASSERT_EQ(model.dof(), 1);
  const seam::Inertial& pair = model.bodies[0].inertial;
  EXPECT_DOUBLE_EQ(pair.mass, 4.0);
  EXPECT_LE((pair.com - Vector3d(0.5, 0.0, 0.0)).norm(), 1e-15);
  const Eigen::Matrix3d expected = Vector3d(0.2, 1.2, 1.2).asDiagonal();
  EXPECT_LE((pair.inertia - expected).norm(), 1e-15);
  EXPECT_EQ(model.frame("c").body, 0);
  EXPECT_LE((model.frame("c").X_body_frame.translation() - Vector3d(1.0, 0.0, 0.0)).norm(), 1e-15);
}

TEST(RobotModel, TurnsInertiaGivenInARotatedFrame) {
  const auto model = read(robot(
      link("a") +
      link("b", R"(<inertial><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><mass value="1"/>
                               <inertia ixx="1" ixy="0.1" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial>)") +
      joint("j", "revolute", "a", "b")));
  Eigen::Matrix3d expected;
  expected << 2.0, -0.1, 0.0, -0.1, 1.0, 0.0, 0.0, 0.0, 2.5;
  EXPECT_LE((model.bodies[0].inertial.inertia - expected).norm(), 1e-15);
  EXPECT_LE((model.bodies[0].inertial.about_origin() - expected -
             Eigen::Matrix3d(Vector3d(1, 1, 0).asDiagonal()))
                .norm(),
            1e-15);
}

// One behind the other: deeper than a stack would bear.
TEST(RobotModel, RefusesMoreJointsThanAnyRobotHas) {
  const auto chain = [](int joints) {
    std::string content = link("0", "");
    for (int i = 1; i <= joints; ++i)
      content += link(std::to_string(i), "") +
                 joint(std::to_string(i), "fixed", std::to_string(i - 1), std::to_string(i), "");
    return robot(content);
  };
  EXPECT_EQ(read(chain(1000)).frames.size(), 1001U);
  EXPECT_EQ(refusal(chain(20000)), "x.urdf: 20000 joints, must be <= 1000");
}

TEST(RobotModel, TakesAnInertialWithoutMassForNone) {
  const auto zeros = read(inertial("0", "0", "0", "0"));
  EXPECT_EQ(zeros.base.inertial.mass, 0.0);
  EXPECT_TRUE(zeros.warnings.empty());
  const auto some = read(inertial("0", "1", "1", "1"));
  EXPECT_TRUE(some.base.inertial.inertia.isZero(0.0));
  EXPECT_EQ(some.warnings, Lines{R"(link "a": its mass is 0, its inertia not: taken for none)"});
}

const char* const point_inertia = R"(<mass value="2"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>)";

// A point of 2 kg, 1 m away from the axis.
TEST(RobotModel, TakesAMassWithoutInertiaForAPoint) {
  const std::string point = R"(<inertial><origin xyz="0 1 0"/>)" + std::string(point_inertia);
  const auto model = read(robot(link("a") + link("b", point) + joint("j", "revolute", "a", "b")));
  EXPECT_EQ(model.bodies[0].inertial.about_origin()(0, 0), 2.0);
  EXPECT_TRUE(model.warnings.empty());
}

// A ball of 2 kg of water has a radius of 78 mm, and 2/5·m·r². What rounding leaves of its arm is no inertia.
TEST(RobotModel, MakesABallOfAPointOnItsAxis) {
  const double radius = std::cbrt(3.0 * 2.0 / (4.0 * M_PI * 1000.0));
  for (const auto& [origin, axis] :
       {std::pair{"0 1 0", "0 1 0"}, std::pair{"0.1 0.2 0.3", "1 2 3"}}) {
    const std::string point =
        R"(<inertial><origin xyz=")" + std::string(origin) + R"("/>)" + point_inertia;
    const auto model = read(robot(link("a") + link("b", point) +
                                  joint("j", "revolute", "a", "b",
                                        std::string(limits) + R"(<axis xyz=")" + axis + R"("/>)")));
    EXPECT_NEAR(model.bodies[0].inertial.inertia(1, 1), 0.4 * 2.0 * radius * radius, 1e-15);
    EXPECT_EQ(
        model.warnings,
        Lines{R"(link "b": has no inertia that joint "j" would meet: 0.0048871 kg m^2 added, )"
              "a ball's of water of its mass"});
  }
}

TEST(RobotModel, CountsTheMergedBodyAndNotEachLink) {
  const std::string sensor = R"(<inertial><origin xyz="0.1 0 0"/><mass value="0.01"/>
    <inertia ixx="-1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-3"/></inertial>)";
  const auto model =
      read(robot(link("a") + link("b") + link("c", sensor) + joint("j", "revolute", "a", "b") +
                 joint("k", "fixed", "b", "c", "")));
  const double moved = 0.01 * 0.1 * 0.1 / 1.01;  // m₁·m₂/(m₁ + m₂)·d²
  const Vector3d expected(1.0 - 1e-4, 1.0 + 1e-4 + moved, 1.0 + 1e-3 + moved);
  EXPECT_LE((model.bodies[0].inertial.inertia.diagonal() - expected).norm(), 1e-15);
  EXPECT_EQ(
      model.warnings,
      Lines{R"(link "c": inertia has the principal moments -0.0001, 0.0001, 0.001 kg m^2, must )"
            "all be > 0: counted as it is, with what it is fixed to"});
}

// 15 % beyond the triangle rule, as a well-known arm's elbow is; and a negative moment about an axis that no joint turns.
TEST(RobotModel, TakesWhatTheJointsDoNotFeel) {
  for (const auto& [ixx, izz] : {std::pair{"0.1", "0.345"}, std::pair{"0.1", "-0.02"}}) {
    const auto model = read(robot(link("a") + link("b", inertial_element("1", ixx, "0.2", izz)) +
                                  joint("j", "revolute", "a", "b")));
    EXPECT_EQ(model.bodies[0].inertial.inertia(2, 2), std::stod(izz));
    EXPECT_EQ(model.warnings.size(), 1U);
  }
}

TEST(RobotModel, TakesRoundedMomentsForZero) {
  const auto model =
      read(robot(link("a") + link("b", inertial_element("1", "0.1", "0.1", "-1e-20")) +
                 joint("j", "revolute", "a", "b")));
  EXPECT_EQ(model.bodies[0].inertial.inertia(2, 2), 0.0);
  EXPECT_EQ(
      model.warnings,
      Lines{R"(link "b": inertia has the principal moments -1e-20, 0.1, 0.1 kg m^2, must all be )"
            "> 0: taken for 0 where they are 0 but for rounding"});
}

TEST(RobotModel, MakesJointsFixedThatMoveNoMass) {
  const std::string stop = R"(<limit lower="0.5" upper="1" effort="1" velocity="1"/>)";
  const auto model =
      read(robot(link("a") + link("b") +
                 link("c", R"(<visual><geometry><sphere radius="1"/></geometry></visual>)") +
                 joint("j", "revolute", "a", "b") +
                 joint("k", "prismatic", "b", "c", stop + R"(<axis xyz="0 0 1"/>)")));
  EXPECT_EQ(model.dof(), 1);
  EXPECT_EQ(model.frame("c").body, 0);
  EXPECT_EQ(model.frame("c").X_body_frame.translation(), Vector3d(0.0, 0.0, 0.5));
  EXPECT_EQ(model.bodies[0].visuals.size(), 1U);
}

// 199 points on links of 0.1 m that fold up: none of them resists well.
TEST(RobotModel, ReadsALongChainOfPointsInNoTime) {
  const std::string point = inertial_element("1", "0", "0", "0");
  std::string content = link("0", "");
  for (int i = 1; i < 200; ++i)
    content += link(std::to_string(i), point) +
               joint(std::to_string(i), "continuous", std::to_string(i - 1), std::to_string(i),
                     R"(<origin xyz="0.1 0 0"/><axis xyz="0 0 1"/>)");
  const auto start = std::chrono::steady_clock::now();
  const auto model = read(robot(content));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(model.warnings.size(), 199U);
}

TEST(RobotModel, FreesWhatMimicsAHeldJoint) {
  const auto model =
      read(robot(link("a") + link("b", "") + link("c") + joint("j", "revolute", "a", "b") +
                 joint("k", "revolute", "a", "c",
                       std::string(limits) + R"(<mimic joint="j" multiplier="2"/>)")));
  EXPECT_EQ(model.dof(), 1);
  EXPECT_FALSE(model.joints[0].follows());
  EXPECT_EQ(model.joints[0].multiplier, 1.0);
}

TEST(RobotModel, TakesCrossedAndMissingLimitsForNone) {
  for (const char* limit : {R"(<limit lower="1" upper="-1" effort="5" velocity="2"/>)", ""}) {
    const auto turns = read(one_joint(limit)).joints[0];
    EXPECT_EQ(turns.type, seam::Joint::Type::continuous);
    EXPECT_EQ(turns.lower, -infinity);
    EXPECT_EQ(turns.upper, infinity);
    const auto slides = read(one_joint(limit, "prismatic"));
    EXPECT_EQ(slides.joints[0].type, seam::Joint::Type::prismatic);
    EXPECT_EQ(slides.joints[0].lower, -infinity);
    EXPECT_EQ(slides.joints[0].upper, infinity);
    EXPECT_EQ(slides.neutral()(0), 0.0);
  }
  const auto bare = read(one_joint(R"(<limit lower="-1" upper="1"/>)")).joints[0];
  EXPECT_EQ(bare.upper, 1.0);
  EXPECT_EQ(bare.effort, infinity);
  EXPECT_EQ(bare.speed, infinity);
}

TEST(RobotModel, KeepsDampingAndFriction) {
  const auto given =
      read(one_joint(std::string(limits) + R"(<dynamics damping="0.5" friction="0.25"/>)"));
  EXPECT_EQ(given.joints[0].damping, 0.5);
  EXPECT_EQ(given.joints[0].friction, 0.25);
  EXPECT_TRUE(given.warnings.empty());
  const auto half = read(one_joint(std::string(limits) + R"(<dynamics friction="0.25"/>)"));
  EXPECT_EQ(half.joints[0].damping, 0.0);
  const auto none = read(one_joint(std::string(limits) + "<dynamics/>"));
  EXPECT_EQ(none.joints[0].damping + none.joints[0].friction, 0.0);
}

TEST(RobotModel, TouchesACapsuleAndDrawsItAsACylinderAndTwoSpheres) {
  const std::string capsule =
      R"(<origin xyz="1 0 0"/><geometry><capsule radius="0.1" length="0.4"/></geometry>)";
  const std::string cylinder = R"(<geometry><cylinder radius="2" length="3"/></geometry>)";
  const auto model = read(
      robot(link("a", "<visual>" + capsule +
                          "</visual><collision><geometry><cdf/></geometry></collision><collision>" +
                          cylinder + "</collision><collision>" + capsule + "</collision>")));
  using Type = seam::Geometry::Type;
  ASSERT_EQ(model.base.collisions.size(), 2U);
  EXPECT_EQ(model.base.collisions[0].type, Type::cylinder);
  EXPECT_EQ(model.base.collisions[1].type, Type::capsule);
  EXPECT_EQ(model.base.collisions[1].size, Vector3d(0.1, 0.0, 0.4));
  ASSERT_EQ(model.base.visuals.size(), 3U);
  EXPECT_EQ(model.base.visuals[0].type, Type::cylinder);
  EXPECT_EQ(model.base.visuals[0].size, Vector3d(0.1, 0.0, 0.4));
  for (const auto& [end, z] : {std::pair{1U, 0.2}, std::pair{2U, -0.2}}) {
    EXPECT_EQ(model.base.visuals[end].type, Type::sphere);
    EXPECT_EQ(model.base.visuals[end].size[0], 0.1);
    EXPECT_EQ(model.base.visuals[end].X_body_shape.translation(), Vector3d(1.0, 0.0, z));
  }
}

TEST(RobotModel, AcceptsAMomentThatIsRoundedUp) {
  EXPECT_EQ(read(inertial("1", "0.1", "0.312", "0.2")).base.inertial.mass, 1.0);
}

TEST(RobotModel, AcceptsPlatesAndRods) {
  EXPECT_NO_THROW(read(inertial("1", "0.1", "0.2", "0.3")));
  EXPECT_NO_THROW(read(inertial("1", "1e-9", "0.2", "0.2")));
}

TEST(RobotModel, LeavesAContinuousJointWithoutLimits) {
  const auto bare = read(one_joint("", "continuous")).joints[0];
  EXPECT_EQ(bare.lower, -infinity);
  EXPECT_EQ(bare.upper, infinity);
  EXPECT_EQ(bare.speed, infinity);
  EXPECT_EQ(bare.effort, infinity);
  const auto limited = read(one_joint(limits, "continuous")).joints[0];
  EXPECT_EQ(limited.upper, infinity);
  EXPECT_EQ(limited.speed, 2.0);
  EXPECT_EQ(limited.effort, 5.0);
}

TEST(RobotModel, TakesALinkWithoutMassWhereWhatIsBehindItResists) {
  const auto model =
      read(robot(link("a") + link("b", "") + link("c") + joint("j", "revolute", "a", "b") +
                 joint("k", "revolute", "b", "c", std::string(limits) + R"(<axis xyz="0 1 0"/>)")));
  EXPECT_EQ(model.dof(), 2);
  EXPECT_EQ(model.bodies[0].inertial.mass, 0.0);
}

TEST(RobotModel, LetsAMimicOfAMimicFollowTheFirst) {
  const auto model = read(three_joints(R"(<mimic joint="j" multiplier="3" offset="0.5"/>)",
                                       R"(<mimic joint="k" multiplier="-2" offset="0.25"/>)", ""));
  EXPECT_EQ(model.joints[0].leader, 2);
  EXPECT_EQ(model.joints[0].multiplier, -6.0);
  EXPECT_EQ(model.joints[0].offset, 3.0 * 0.25 + 0.5);
  EXPECT_EQ(model.joints[1].leader, 2);
  EXPECT_FALSE(model.joints[2].follows());
  EXPECT_EQ(model.neutral(), Vector3d(1.25, 0.25, 0.0));
  Eigen::VectorXd q = Vector3d(7.0, 7.0, 0.5);
  model.place_followers(q);
  EXPECT_EQ(q, Vector3d(-1.75, -0.75, 0.5));
}

TEST(RobotModel, BeginsWithinItsLimits) {
  const auto model = read(one_joint(R"(<limit lower="-2" upper="-0.5" effort="5" velocity="2"/>)"));
  EXPECT_EQ(model.neutral()(0), -0.5);
}

TEST(RobotModel, TakesMultiplierOneAndNoOffsetWhereAMimicNamesNone) {
  const auto model = read(three_joints("", R"(<mimic joint="i"/>)", ""));
  EXPECT_EQ(model.joints[1].multiplier, 1.0);
  EXPECT_EQ(model.joints[1].offset, 0.0);
}

TEST(RobotModel, LeavesMissingMeshesOutWhereItIsTold) {
  const TempFolder folder;
  seam::UrdfSettings lenient;
  lenient.leave_out_missing_meshes = true;
  const std::string file = folder.write(
      "x.urdf",
      robot(link("a",
                 R"(<visual><geometry><mesh filename="package://none/no.obj"/></geometry></visual>)"
                 R"(<visual><geometry><sphere radius="1"/></geometry></visual>)")));
  const auto model = RobotModel::read(file, lenient);
  EXPECT_EQ(model.base.visuals.size(), 1U);
  ASSERT_EQ(model.missing_meshes.size(), 1U);
  EXPECT_EQ(
      model.missing_meshes[0].find(R"(link "a": visual: mesh "package://none/no.obj" not found)"),
      0U);
}

TEST(RobotModel, MakesAxesUnitAndTakesUrdfsDefault) {
  EXPECT_EQ(read(one_joint(std::string(limits) + R"(<axis xyz="0 0 -4"/>)")).joints[0].axis,
            Vector3d(0, 0, -1));
  EXPECT_EQ(read(one_joint(limits)).joints[0].axis, Vector3d(1, 0, 0));
  EXPECT_EQ(read(one_joint(std::string(limits) + R"(<axis xyz="0 1e308 0"/>)")).joints[0].axis,
            Vector3d(0, 1, 0));
}

TEST(RobotModel, KeepsShapesWithTheirColours) {
  const auto model = read(robot(
      R"(<material name="red"><color rgba="1 0 0 0.5"/></material>)" +
      link(
          "a",
          R"(<visual><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
                                             <visual><geometry><cylinder radius="1" length="4"/></geometry><material name="unknown"/></visual>)")));
  ASSERT_EQ(model.base.visuals.size(), 2U);
  const seam::Geometry& box = model.base.visuals[0];
  EXPECT_EQ(box.type, seam::Geometry::Type::box);
  EXPECT_EQ(box.size, Vector3d(1, 2, 3));
  EXPECT_EQ(box.X_body_shape.translation(), Vector3d(0, 0, 1));
  EXPECT_TRUE(box.has_colour);
  EXPECT_EQ(box.colour, Eigen::Vector4d(1, 0, 0, 0.5));
  EXPECT_EQ(model.base.visuals[1].size, Vector3d(1, 0, 4));
  EXPECT_FALSE(model.base.visuals[1].has_colour);
}

class MeshNames : public testing::Test {
 protected:
  MeshNames() {
    folder_.write("arm/meshes/m.obj", "own");
    folder_.write("packages/tool/m.obj", "package");
    folder_.write("ros/tool/ros.obj", "ros");
  }
  ~MeshNames() override { unsetenv("ROS_PACKAGE_PATH"); }

  /// Where the name leads, from arm/urdf/x.urdf, relative to the test's folder.
  std::string found(const std::string& name,
                    const std::vector<std::string>& package_path = {}) const {
    const std::string file =
        folder_.write("arm/urdf/x.urdf", shape("visual", R"(<mesh filename=")" + name + R"("/>)"));
    const auto model = RobotModel::read(file, {package_path});
    return std::filesystem::relative(model.base.visuals[0].mesh, folder_.path("")).string();
  }

  TempFolder folder_;
};

TEST_F(MeshNames, AreRelativeToTheUrdf) {
  EXPECT_EQ(found("../meshes/m.obj"), "arm/meshes/m.obj");
}
TEST_F(MeshNames, MayBeFileUris) {
  EXPECT_EQ(found("file://" + folder_.path("arm/meshes/m.obj")), "arm/meshes/m.obj");
}
TEST_F(MeshNames, FindAPackageAboveTheUrdf) {
  EXPECT_EQ(found("package://arm/meshes/m.obj"), "arm/meshes/m.obj");
}
TEST_F(MeshNames, MayHaveASlashTooMany) {
  EXPECT_EQ(found("package:///arm/meshes/m.obj"), "arm/meshes/m.obj");
}
TEST_F(MeshNames, FindAPackageThatAFolderAboveTheUrdfHolds) {
  folder_.write("other/m.obj", "beside");
  EXPECT_EQ(found("package://other/m.obj"), "other/m.obj");
}
TEST_F(MeshNames, FindAPackageInTheGivenFolders) {
  EXPECT_EQ(found("package://tool/m.obj", {folder_.path("packages")}), "packages/tool/m.obj");
  EXPECT_EQ(found("package://tool/m.obj", {folder_.path("packages/tool")}), "packages/tool/m.obj");
}
TEST_F(MeshNames, FindAPackageInRosPackagePath) {
  setenv("ROS_PACKAGE_PATH", (folder_.path("none") + ":" + folder_.path("ros")).c_str(), 1);
  EXPECT_EQ(found("package://tool/ros.obj", {folder_.path("packages")}), "ros/tool/ros.obj");
}

}  // namespace
