#include <cstring>

#include <gmock/gmock.h>

#include "scenes/obstacles.hpp"
#include "scenes/play.hpp"
#include "tests/own_scene.hpp"
#include "tests/refusals.hpp"

namespace seam {
namespace {

using Eigen::Vector3d;
using test::BadFile;
using test::outcome;

// A ball of 5 cm at the end of a rod of 40 cm that swings about y.
const char* const arm_urdf = R"(<robot name="r"><link name="base"/>
<link name="l"><inertial><origin xyz="0 0 0.4"/><mass value="1"/><inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 0.4"/><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="j" type="revolute"><parent link="base"/><child link="l"/><axis xyz="0 1 0"/>
<limit lower="-3" upper="3" effort="100" velocity="5"/></joint></robot>)";

struct Swing : test::OneJoint {
  Swing() : OneJoint(arm_urdf, "settle: 0.2\n") {}
  Scene read(const std::string& obstacles) const {
    return OneJoint::read({"obstacles=[" + obstacles + "]"});
  }
};

Vector3d end_of_rod(const Recording& played, Eigen::Index row) {
  const double q = played.q(row, 0);
  return {0.4 * std::sin(q), 0.0, 0.4 * std::cos(q)};
}

// Bullet's edges are round by its margin.
double distance_to_box(const Vector3d& place, const Vector3d& half) {
  const double margin = 1e-3;
  const Vector3d beyond = place.cwiseAbs() - half + Vector3d::Constant(margin);
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0) - margin;
}

TEST(Obstacle, GoesItsWayFromRestToRest) {
  SolidObstacle obstacle;
  obstacle.at << 1.0, 2.0, 3.0;
  EXPECT_EQ(obstacle.position(7.0), obstacle.at);
  obstacle.way << 0.4, 0.0, -0.2;
  obstacle.leaves = 0.5;
  obstacle.over = 2.0;
  EXPECT_EQ(obstacle.position(0.4), obstacle.at);
  EXPECT_TRUE(obstacle.position(1.5).isApprox(Vector3d(1.2, 2.0, 2.9)));
  EXPECT_TRUE(obstacle.position(2.5).isApprox(Vector3d(1.4, 2.0, 2.8)));
  EXPECT_TRUE(obstacle.position(9.0).isApprox(Vector3d(1.4, 2.0, 2.8)));
  EXPECT_LT((obstacle.position(0.5 + 1e-3) - obstacle.at).norm(), 1e-8);
}

// Against the distances of spheres and boxes in closed form, at every tick.
TEST(Obstacles, AreAsFarFromTheArmAsTheyAre) {
  const Swing swing;
  const auto check = [&](const std::string& obstacles, auto&& distance) {
    const Scene scene = swing.read(obstacles);
    const Recording played = play(scene, Join::dmp3, scene.dt);
    double least = 1e9;
    int touched = 0;
    for (Eigen::Index k = 0; k < played.ticks(); ++k) {
      const double now = distance(end_of_rod(played, k), static_cast<double>(k) * scene.dt) - 0.05;
      least = std::min(least, now);
      touched += now <= 0.0;
    }
    EXPECT_NEAR(outcome(played, "obstacle_distance_m"), least, 1e-6) << obstacles;
    EXPECT_NEAR(outcome(played, "touched_share"),
                static_cast<double>(touched) / static_cast<double>(played.ticks()),
                1.5 / static_cast<double>(played.ticks()))
        << obstacles;
    return least;
  };
  EXPECT_GT(
      check("{ball: {at: [0.3, 0.3, 0.4], radius: 0.1}}",
            [](const Vector3d& p, double) { return (p - Vector3d(0.3, 0.3, 0.4)).norm() - 0.1; }),
      0.1);
  EXPECT_LT(
      check("{ball: {at: [0.3, 0, 0.4], radius: 0.1}}",
            [](const Vector3d& p, double) { return (p - Vector3d(0.3, 0.0, 0.4)).norm() - 0.1; }),
      -0.04);
  check("{box: {at: [0.45, 0, 0.4], size: [0.1, 0.2, 0.3]}}", [](const Vector3d& p, double) {
    return distance_to_box(p - Vector3d(0.45, 0.0, 0.4), {0.05, 0.1, 0.15});
  });
  SolidObstacle moving;
  moving.at << 0.6, 0.0, 0.4;
  moving.way << -0.3, 0.0, 0.0;
  moving.leaves = 0.2;
  moving.over = 0.7;
  const auto to_moving = [&](const Vector3d& p, double time) {
    return distance_to_box(p - moving.position(time), Vector3d::Constant(0.03));
  };
  const std::string box =
      "{box: {at: [0.6, 0, 0.4], size: [0.06, 0.06, 0.06]}, moves: {to: [0.3, 0, 0.4], from: 0.2, "
      "over: "
      "0.7}}";
  check(box, to_moving);
  check(box + ", {ball: {at: [0, 0.4, 0.4], radius: 0.1}}", [&](const Vector3d& p, double time) {
    return std::min(to_moving(p, time), (p - Vector3d(0.0, 0.4, 0.4)).norm() - 0.1);
  });
}

TEST(Obstacles, DoNotPush) {
  const Swing swing;
  const Scene blocked = swing.read("{ball: {at: [0.3, 0, 0.3], radius: 0.1}}");
  const Scene free = Scene::read(swing.path);
  const Recording a = play(blocked, Join::dmp3, 1e-3), b = play(free, Join::dmp3, 1e-3);
  EXPECT_GT(outcome(a, "touched_share"), 0.1);
  ASSERT_EQ(a.q.size(), b.q.size());
  EXPECT_EQ(
      std::memcmp(a.q.data(), b.q.data(), sizeof(double) * static_cast<std::size_t>(a.q.size())),
      0);
}

TEST(Obstacles, AreSeenWhereTheyAre) {
  const Swing swing;
  const Scene scene = swing.read(
      "{ball: {at: [1, 0, 0], radius: 0.1}, moves: {to: [2, 0, 0], from: 0, over: 1}}, "
      "{box: {at: [0, 9, 0], size: [1, 2, 3]}}");
  Replay replay;
  play(scene, Join::dmp3, scene.dt, &replay);
  const std::size_t last = replay.parts.size() - 1;
  EXPECT_NEAR(replay.pose(30, last - 1).translation().x(), 1.5, 1e-6);
  EXPECT_EQ(replay.parts[last].visuals[0].size, Vector3d(1, 2, 3));
  EXPECT_EQ(replay.pose(30, last).translation().y(), 9.0);
}

TEST(Obstacles, MoveFasterInAFasterScene) {
  const Swing swing;
  const std::string ball =
      "obstacles=[{ball: {at: [1, 0, 0], radius: 0.1}, moves: {to: [2, 0, 0], from: 1, over: 3}}]";
  const Scene fast = Scene::read(swing.path, {ball, "speed=2"});
  EXPECT_EQ(fast.obstacles[0].leaves, 0.5);
  EXPECT_EQ(fast.obstacles[0].over, 1.5);
}

class ObstaclesRefuse : public testing::TestWithParam<BadFile> {};

TEST_P(ObstaclesRefuse, WithFileLineAndKey) {
  test::expect_refused(
      GetParam(),
      test::scene_text("line") +
          "obstacles:\n  - {box: {at: [5, 0, 0], size: [1, 1, 1]}, moves: {to: [6, 0, 0], "
          "from: 0.5, over: 1}}\n",
      TempFolder(), [](const std::string& path) { Scene::read(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , ObstaclesRefuse,
    testing::Values(
        BadFile{"NoShape", "box: {at: [5, 0, 0], size: [1, 1, 1]}, ", "",
                ":23: key \"obstacles\": must have one of box, ball"},
        BadFile{"TwoShapes", "moves:", "ball: {at: [5, 0, 0], radius: 1}, moves:",
                ":23: key \"obstacles\": must have one of box, ball"},
        BadFile{"FlatBox", "size: [1, 1, 1]", "size: [1, 1, 0]", ":23: key \"size\": must be > 0"},
        BadFile{"BallOfNothing", "box: {at: [5, 0, 0], size: [1, 1, 1]}",
                "ball: {at: [5, 0, 0], radius: 0}", ":23: key \"radius\": 0, must be > 0"},
        BadFile{"NoPlace", "at: [5, 0, 0], ", "", ":23: key \"box\": needs the key \"at\""},
        BadFile{"NoTime", ", over: 1", "", ":23: key \"moves\": needs the key \"over\""},
        BadFile{"AtOnce", "over: 1", "over: 0", ":23: key \"over\": 0, must be > 0"},
        BadFile{"NoWay", "to: [6, 0, 0], ", "", ":23: key \"moves\": needs the key \"to\""},
        BadFile{"UnknownKey", "over: 1", "under: 1", ":23: key \"under\": not known here"}),
    test::by_name);

}  // namespace
}  // namespace seam
