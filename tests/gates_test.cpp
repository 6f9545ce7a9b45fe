#include "scenes/gates.hpp"

#include <random>

#include <gmock/gmock.h>

#include "scenes/play.hpp"
#include "tests/own_scene.hpp"
#include "tests/refusals.hpp"

namespace seam {
namespace {

using Eigen::Vector3d;
using test::BadFile;
using test::outcome;
using test::own_scene;

Gate random_gate(std::mt19937& random) {
  Gate gate;
  gate.X_world_gate = Eigen::Translation3d(Vector3d::NullaryExpr([&] {
                        return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
                      })) *
                      Eigen::Quaterniond::UnitRandom();
  gate.opening = std::uniform_real_distribution<double>(0.02, 0.2)(random);
  return gate;
}

// On a straight line, in steps of any length, the crossing falls between two places.
TEST(Passage, KeepsFromTheFrameWhatItsOffsetLeaves) {
  const unsigned seed = 3;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> even(-0.15, 0.15);
  for (int i = 0; i < 200; ++i) {
    const Gate gate = random_gate(random);
    const double y = even(random), z = even(random);
    const Vector3d step(0.013, even(random), even(random));
    Passage passage(gate);
    for (double s = -5.0 - std::abs(even(random)); s < 5.0; s += 1.0)
      passage.go_to(gate.X_world_gate * (Vector3d(0.0, y, z) + s * step));
    EXPECT_NEAR(passage.clearance(), 0.5 * gate.opening - std::max(std::abs(y), std::abs(z)),
                1e-12);
  }
}

TEST(Passage, CountsTheBestInTheGatesDirection) {
  const Gate gate;
  const auto clearance = [&](const std::vector<Vector3d>& way) {
    Passage passage(gate);
    for (const Vector3d& place : way) passage.go_to(place);
    return passage.clearance();
  };
  EXPECT_EQ(clearance({}), -0.06);
  EXPECT_EQ(clearance({{-1, 0, 0}, {-0.1, 0, 0}}), -0.06) << "never there";
  EXPECT_EQ(clearance({{1, 0, 0}, {-1, 0, 0}}), -0.06) << "backwards";
  EXPECT_NEAR(clearance({{-1, 0, 0}, {0, 0, 0.01}}), 0.02, 1e-15) << "ends in the plane";
  EXPECT_NEAR(clearance({{-1, 0.5, 0}, {1, 0.5, 0}}), -0.47, 1e-15) << "beside it";
  EXPECT_NEAR(
      clearance({{-1, 0.5, 0}, {1, 0.5, 0}, {-1, 0, 0}, {1, 0.02, 0.01}, {-1, 1, 1}, {1, 1, 1}}),
      0.02, 1e-15)
      << "at the second try";
}

// The tool crosses a gate that stands across its way, beside its middle by as much as the gate was moved.
TEST(Gates, AreClearedByWhatTheToolLeaves) {
  const Recording way = play(own_scene("carrying", {"liquid.frozen=yes"}), Join::dmp3, 1e-3);
  const auto list = [](const Vector3d& v) {
    std::ostringstream text;
    text.precision(17);
    text << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
    return text.str();
  };
  const auto gate = [&](Eigen::Index row, double beside) {
    const Vector3d place = way.tool_ref.row(row).transpose();
    const Vector3d along = way.tool_vel.row(row).transpose();
    const Vector3d y = Vector3d::UnitZ().cross(along).normalized();
    return "{at: " + list(place + beside * y) + ", axis: " + list(along) + ", opening: 0.05}";
  };
  const auto clearance = [&](const std::string& gates) {
    const Scene scene = own_scene("carrying", {"liquid.frozen=yes", "gates=[" + gates + "]"});
    return outcome(play(scene, Join::dmp3, 1e-3), "clearance_m");
  };
  EXPECT_NEAR(clearance(gate(700, 0.0)), 0.025, 1e-6);
  EXPECT_NEAR(clearance(gate(700, 0.01)), 0.015, 1e-6);
  EXPECT_NEAR(clearance(gate(600, -0.015) + ", " + gate(1000, 0.04)), -0.015, 1e-6);
}

TEST(Gates, AreSeenWhereTheyStand) {
  const Scene scene = own_scene(
      "carrying",
      {"gates=[{at: [0.5, -0.1, 0.2], axis: [0, 1, 0]}, {at: [1, 0, 0], axis: [0, 0, 2]}]"});
  ASSERT_EQ(scene.gates.size(), 2U);
  EXPECT_TRUE(scene.gates[0].X_world_gate.linear().col(0).isApprox(Vector3d::UnitY()));
  EXPECT_TRUE(scene.gates[0].X_world_gate.linear().col(2).isApprox(Vector3d::UnitZ()));
  EXPECT_TRUE(scene.gates[1].X_world_gate.linear().isUnitary(1e-12));
  Replay replay;
  play(scene, Join::dmp3, scene.dt, &replay);
  const std::size_t last = replay.parts.size() - 1;
  ASSERT_EQ(replay.parts[last].name, "gate");
  EXPECT_EQ(replay.parts[last].visuals.size(), 4U);
  EXPECT_TRUE(replay.pose(9, last - 1).translation().isApprox(Vector3d(0.5, -0.1, 0.2), 1e-6));
  // No bar is nearer to the middle than half the opening.
  for (const Geometry& bar : replay.parts[last].visuals) {
    const Vector3d inner = bar.X_body_shape.translation().cwiseAbs() - 0.5 * bar.size;
    EXPECT_NEAR(inner.tail<2>().maxCoeff(), 0.03, 1e-12);
  }
}

class GatesRefuse : public testing::TestWithParam<BadFile> {};

TEST_P(GatesRefuse, WithFileLineAndKey) {
  test::expect_refused(GetParam(),
                       test::scene_text("carrying") +
                           "gates:\n  - {at: [0.5, 0, 0.2], axis: [0, 1, 0], opening: 0.05}\n",
                       TempFolder(), [](const std::string& path) { Scene::read(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , GatesRefuse,
    testing::Values(
        BadFile{"NoPlace", "at: [0.5, 0, 0.2], ", "", ":32: key \"gates\": needs the key \"at\""},
        BadFile{"FlatPlace", "at: [0.5, 0, 0.2]", "at: [0.5, 0]", ":32: key \"at\": "},
        BadFile{"NoDirection", "axis: [0, 1, 0]", "axis: [0, 0, 0]",
                ":32: key \"axis\": must have a direction"},
        BadFile{"Closed", "opening: 0.05", "opening: 0", ":32: key \"opening\": 0, must be > 0"},
        BadFile{"UnknownKey", "opening:", "wide:", ":32: key \"wide\": not known here"},
        BadFile{"NoList", "  - {at", "  gate: {at", ":31: key \"gates\": "}),
    test::by_name);

}  // namespace
}  // namespace seam
