#include "scenes/ball.hpp"

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

FlyingBall thrown_ball() {
  FlyingBall ball;
  ball.thrown = 0.3;
  ball.at << 1.0, 0.2, 0.5;
  ball.velocity << -0.6, 0.1, 3.0;
  ball.acceleration << 0.0, 0.0, -9.81;
  ball.caught = 0.8004;
  return ball;
}

Eigen::Matrix3Xd way_of(const std::function<Vector3d(double)>& place, int ticks, double dt) {
  Eigen::Matrix3Xd way(3, ticks);
  for (int k = 0; k < ticks; ++k) way.col(k) = place(k * dt);
  return way;
}

TEST(Ball, FliesAsGravityHasIt) {
  const FlyingBall ball = thrown_ball();
  EXPECT_EQ(ball.position(0.1), ball.at);
  EXPECT_EQ(ball.velocity_at(0.1), Vector3d::Zero());
  const double h = 1e-3;
  for (const double t : {0.4, 0.7, 1.5}) {
    const Vector3d before = ball.position(t - h), now = ball.position(t),
                   after = ball.position(t + h);
    EXPECT_LT(((after - before) / (2.0 * h) - ball.velocity_at(t)).norm(), 1e-9);
    EXPECT_LT(((after - 2.0 * now + before) / (h * h) - ball.acceleration).norm(), 1e-6);
  }
  FlyingBall fast = ball;
  fast.hasten(2.0);
  EXPECT_TRUE(fast.position(0.35).isApprox(ball.position(0.7), 1e-14));
  EXPECT_TRUE(fast.velocity_at(0.35).isApprox(2.0 * ball.velocity_at(0.7), 1e-14));
}

TEST(Forecast, IsExactWhereNothingBlursTheSight) {
  const FlyingBall ball = thrown_ball();
  Forecast forecast(ball.caught, ball.acceleration);
  for (int i = 0; i < 7; ++i) {
    const double t = 0.31 + 0.02 * i;
    forecast.see(t, ball.position(t));
    if (i == 0) continue;
    EXPECT_LT((forecast.position() - ball.position(ball.caught)).norm(), 1e-12);
    EXPECT_LT((forecast.velocity() - ball.velocity_at(ball.caught)).norm(), 1e-11);
  }
}

// Against an orthogonal decomposition of the same least-squares problem.
TEST(Forecast, IsTheFlightThatFitsBest) {
  const unsigned seed = 11;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.01);
  const FlyingBall ball = thrown_ball();
  Forecast forecast(ball.caught, ball.acceleration);
  const int pictures = 12;
  Eigen::MatrixXd A(pictures, 2), b(pictures, 3);
  for (int i = 0; i < pictures; ++i) {
    const double t = 0.3 + i / 30.0, s = t - ball.caught;
    const Vector3d seen = ball.position(t) + Vector3d::NullaryExpr([&] { return noise(random); });
    forecast.see(t, seen);
    A.row(i) << 1.0, s;
    b.row(i) = (seen - 0.5 * s * s * ball.acceleration).transpose();
  }
  const Eigen::MatrixXd best = A.colPivHouseholderQr().solve(b);
  EXPECT_LT((forecast.position() - best.row(0).transpose()).norm(), 1e-12);
  EXPECT_LT((forecast.velocity() - best.row(1).transpose()).norm(), 1e-11);
}

TEST(Miss, IsNothingWhereTheHandGoesWithTheBall) {
  const FlyingBall ball = thrown_ball();
  const Miss none =
      miss(ball, way_of([&](double t) { return ball.position(t); }, 1500, 1e-3), 1e-3);
  EXPECT_LT(none.place, 1e-12);
  EXPECT_LT(none.velocity, 1e-9);
  // And nothing else of a hand that is elsewhere before and after.
  const auto touching = [&](double t) -> Vector3d {
    const double s = t - ball.caught;
    return ball.position(t) + s * s * Vector3d(1.0, -2.0, 0.5);
  };
  const Miss touch = miss(ball, way_of(touching, 1500, 1e-3), 1e-3);
  EXPECT_LT(touch.place, 1e-12);
  EXPECT_LT(touch.velocity, 1e-9);
  EXPECT_LT(touch.time, 2e-4);
}

TEST(Miss, IsWhatTheHandIsOffByInPlaceVelocityAndTime) {
  const FlyingBall ball = thrown_ball();
  const Vector3d off(0.003, -0.004, 0.0);
  const auto beside = [&](double t) -> Vector3d {
    return ball.position(t) + off + (t - ball.caught) * Vector3d(0.0, 0.0, 0.5);
  };
  const Miss missed = miss(ball, way_of(beside, 1500, 1e-3), 1e-3);
  EXPECT_NEAR(missed.place, 0.005, 1e-12);
  EXPECT_NEAR(missed.velocity, 0.5, 1e-9);
  EXPECT_NEAR(missed.time, 0.0, 1e-9);
  // A hand at rest where a ball on a line comes by 20.3 ms too late.
  FlyingBall carried = ball;
  carried.acceleration.setZero();
  const Vector3d there = carried.position(carried.caught + 0.0203);
  const Miss late = miss(carried, way_of([&](double) { return there; }, 1500, 1e-3), 1e-3);
  EXPECT_NEAR(late.time, 0.0203, 1e-9);
  EXPECT_NEAR(late.place, 0.0203 * carried.velocity.norm(), 1e-12);
  EXPECT_NEAR(late.velocity, carried.velocity.norm(), 1e-9);
}

std::string list(const Vector3d& v) {
  std::ostringstream text;
  text.precision(17);
  text << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
  return text.str();
}

// A ball that happens to be where the hand comes by, as fast as the hand, and one beside it.
TEST(Ball, IsInTheHandThatIsThereAsFastAsTheBall) {
  const Recording way = play(own_scene("carrying", {"liquid.frozen=yes"}), Join::dmp3, 1e-3);
  const Vector3d place = way.tool_ref.row(700).transpose(),
                 velocity = way.tool_vel.row(700).transpose();
  const auto played = [&](const Vector3d& beside, Replay& replay) {
    const Scene scene = own_scene(
        "carrying", {"liquid.frozen=yes", "ball={at: " + list(place + beside - 0.5 * velocity) +
                                              ", velocity: " + list(velocity) +
                                              ", carried: yes, thrown: 0.2, caught: 0.7}"});
    return play(scene, Join::dmp3, 1e-3, &replay);
  };
  Replay replay;
  const Recording caught = played(Vector3d::Zero(), replay);
  EXPECT_LT(outcome(caught, "miss_m"), 1e-9);
  EXPECT_LT(outcome(caught, "velocity_miss_m_s"), 1e-4);
  EXPECT_LT(outcome(caught, "time_miss_s"), 1e-3);
  const auto from_tool = [&](Eigen::Index frame) -> double {
    const Vector3d tool = replay.tool.row(frame).transpose().cast<double>();
    return (replay.pose(frame, replay.parts.size() - 1).translation() - tool).norm();
  };
  EXPECT_GT(from_tool(20), 0.05);
  EXPECT_LT(from_tool(replay.frames() - 1), 1e-5) << "gone with the hand";
  replay = Replay();
  const Recording missed = played({0.0, 0.0, 0.05}, replay);
  EXPECT_NEAR(outcome(missed, "miss_m"), 0.05, 1e-9);
  EXPECT_GT(from_tool(replay.frames() - 1), 0.2) << "gone its own way";
}

class BallRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(BallRefuses, WithFileLineAndKey) {
  test::expect_refused(GetParam(),
                       test::scene_text("carrying") +
                           "ball: {at: [1, 0, 0], velocity: [0, 0, 3], thrown: 0.1, caught: 0.9,\n"
                           "  seen: {from: 0.2, to: 0.6, every: 0.04, noise: 0.002, least: 4}}\n",
                       TempFolder(), [](const std::string& path) { Scene::read(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , BallRefuses,
    testing::Values(
        BadFile{"NoPlace", "{at: [1, 0, 0], ", "{", ":31: key \"ball\": needs the key \"at\""},
        BadFile{"CaughtBeforeItIsThrown", "caught: 0.9", "caught: 0.1",
                ":31: key \"caught\": 0.1, must be > thrown"},
        BadFile{"CaughtTooLate", "caught: 0.9", "caught: 9",
                ":31: key \"caught\": must be before the run ends"},
        BadFile{"SeenBeforeItIsThrown", "from: 0.2", "from: 0.05",
                ":32: key \"from\": must be >= thrown"},
        BadFile{"SeenWhenItIsCaught", "to: 0.6", "to: 1.0", ":32: key \"to\": must be < caught"},
        BadFile{"SeenBackwards", "to: 0.6", "to: 0.1", ":32: key \"to\": 0.1, must be >= from"},
        BadFile{"SeenOnce", "least: 4", "least: 1", ":32: key \"least\": "},
        BadFile{"SeenTooSeldom", "least: 4", "least: 40",
                ":32: key \"seen\": has fewer pictures than a forecast takes"},
        BadFile{"NothingToMove", "least: 4", "least: 5",
                ":32: key \"seen\": needs a step of the sequence with a hit"},
        BadFile{"NegativeNoise", "noise: 0.002", "noise: -1",
                ":32: key \"noise\": -1, must be >= 0"},
        BadFile{"CarriedPerhaps", "thrown: 0.1", "thrown: 0.1, carried: perhaps",
                ":31: key \"carried\": \"perhaps\", must be "},
        BadFile{"UnknownKey", "thrown:", "throne:", ":31: key \"throne\": not known here"}),
    test::by_name);

TEST(Ball, NeedsAHand) {
  EXPECT_THAT(test::refusal([] {
                Scene::read(std::string(SEAM_SCENES) + "/line.yaml",
                            {"ball={at: [1, 0, 0], velocity: [0, 0, 1], thrown: 0, caught: 1}"});
              }),
              testing::HasSubstr("needs a tool that catches it"));
}

}  // namespace
}  // namespace seam
