#include <cmath>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/obstacles.hpp>
#include <seam/sequencer.hpp>

namespace seam {
namespace {

using testing::HasSubstr;
using Vector = Eigen::Vector3d;

const std::vector<std::string> tool{"x", "y", "z"};

// A hand that goes by minimum jerk from 0 along a way of 0.3 m in a second: 0.56 m/s at the most.
Sequence hand(const Vector& way = {0.3, 0.0, 0.0}) {
  const Demonstration one = test::minimum_jerk();
  Demonstration demo = one;
  demo.coordinates = tool;
  demo.position = one.position * way.transpose();
  demo.velocity = one.velocity * way.transpose();
  demo.acceleration = one.acceleration * way.transpose();
  Sequence task;
  task.then(learn(demo));
  return task;
}

Vector force(const Obstacle& obstacle, const Vector& at, const Vector& moving = Vector::Zero(),
             double time = 0.0) {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(3);
  obstacle.add(at, moving, time, c);
  return c;
}

struct Passed {
  double nearest = INFINITY;  // [m]
  double peak = 0.0;          // [m/s²]
  Vector end;
};

Passed passed(const std::shared_ptr<Obstacle>& obstacle, const JoinSettings& method, bool avoids) {
  const Sequence task = hand();
  Sequencer sequencer(task, method, task.start_state());
  if (avoids) sequencer.add_coupling(obstacle);
  Passed all;
  for (int k = 0; k < 2500; ++k) {
    sequencer.step(1e-3);
    const Sample& at = sequencer.sample();
    all.nearest = std::min(all.nearest, obstacle->distance(at.position, sequencer.motion_time()));
    all.peak = std::max(all.peak, at.acceleration.norm());
  }
  all.end = sequencer.sample().position;
  return all;
}

// With the settings as they are by default.
TEST(Obstacle, IsKeptAwayFromOnTheWayToTheGoal) {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.7, Vector(0.0, 0.3, 1.0).normalized()));
  Box box;
  box.size = {0.06, 0.06, 0.06};
  box.orientation = turned;
  const struct {
    std::variant<Steering, Ball, Box> shape;
    double keeps;
  } cases[] = {{Steering{}, 0.06}, {Ball{}, 0.03}, {box, 0.03}};
  for (const auto& [shape, keeps] : cases)
    for (const double beside : {0.004, -0.02, 0.03})
      for (const Join method : all_joins) {
        ObstacleSettings settings;
        settings.at = {0.15, beside, 0.003};
        settings.shape = shape;
        const auto obstacle = std::make_shared<Obstacle>(tool, settings);
        const Passed with = passed(obstacle, method, true);
        EXPECT_LT(passed(obstacle, method, false).nearest, shape.index() == 0 ? 0.035 : 0.0);
        EXPECT_GT(with.nearest, keeps) << shape.index() << " at " << beside;
        EXPECT_LT(with.peak, 20.0) << shape.index() << " at " << beside;
        EXPECT_LT((with.end - Vector(0.3, 0.0, 0.0)).norm(), 1e-3) << shape.index() << beside;
      }
}

// The paper's formula, with its quarter turn, where nothing is windowed.
TEST(Steering, IsThePapersWhereThePointIsNearAndAhead) {
  std::mt19937_64 random(81);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vector(normal(random), normal(random), normal(random)); };
  const Steering steering{700.0, 4.0, 1e3};
  for (int i = 0; i < 1000; ++i) {
    const Vector o = any(), y = any(), yd = any();
    const double angle = std::acos((o - y).normalized().dot(yd.normalized()));
    const Vector axis = (o - y).cross(yd).normalized();
    const Vector turned = Eigen::AngleAxisd(M_PI / 2.0, axis) * yd;
    const Obstacle obstacle(tool, {o, steering, {}, {}, {}});
    const Vector c = force(obstacle, y, yd);
    EXPECT_LT(std::abs(c.dot(yd)), 1e-10 * (1.0 + c.norm() * yd.norm()));
    if (angle > M_PI / 2.0) continue;
    const Vector paper = 700.0 * turned * angle * std::exp(-4.0 * angle);
    EXPECT_LT((c - paper).norm(), 1e-9 * (1.0 + paper.norm())) << "seed 81, case " << i;
  }
}

TEST(Steering, IsContinuousWhereTheAngleOrTheSpeedPassesThroughNothing) {
  const Obstacle obstacle(tool, {Vector(0.1, 0.0, 0.0), Steering{}, {}, {}, {}});
  const Vector y(0.0, 0.0, 0.0);
  EXPECT_EQ(force(obstacle, y, Vector::Zero()), Vector::Zero());
  EXPECT_EQ(force(obstacle, Vector(0.1, 0.0, 0.0), Vector(0.5, 0.0, 0.0)), Vector::Zero());
  for (const double ahead : {0.5, -0.5})
    for (const double little : {0.0, 1e-300, 1e-160, 1e-12, 1e-8, 1e-5})
      for (const double side : {-1.0, 1.0}) {
        const Vector c = force(obstacle, y, Vector(ahead, side * little, 0.0));
        EXPECT_TRUE(c.allFinite());
        EXPECT_LE(c.norm(), 1000.0 * (little + 1e-9)) << ahead << " " << little;
        EXPECT_GE(c.y() * side, -1e-14);
        EXPECT_LE(force(obstacle, y, little * Vector(0.6, side, 0.0)).norm(), 1000.0 * little);
      }
}

TEST(Steering, BendsTheMotionAwayFromThePoint) {
  const Obstacle obstacle(tool, {Vector(0.1, 0.01, 0.0), Steering{}, {}, {}, {}});
  EXPECT_LT(force(obstacle, Vector::Zero(), Vector(0.5, 0.0, 0.0)).y(), -0.1);
}

Box any_box(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.05, 0.3);
  std::normal_distribution<double> normal;
  Box box;
  box.size = {uniform(random), uniform(random), uniform(random)};
  box.orientation =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
          .normalized();
  box.reach = uniform(random);
  return box;
}

// How far the nearest and the next side are from changing places, of a point inside.
bool near_an_edge_within(const Box& box, const Vector& from_centre) {
  Vector beyond = (box.orientation.conjugate() * from_centre).cwiseAbs() - 0.5 * box.size;
  if (beyond.maxCoeff() > 1e-4) return false;
  std::sort(beyond.begin(), beyond.end());
  return beyond(2) - beyond(1) < 1e-4 || beyond(2) > -1e-4;
}

TEST(Obstacle, PushesWithTheNegativeGradientOfItsPotential) {
  std::mt19937_64 random(82);
  std::uniform_real_distribution<double> uniform(-0.4, 0.4);
  int within = 0, beside = 0;
  for (int i = 0; i < 10000; ++i) {
    const Box box = any_box(random);
    const Vector centre(uniform(random), uniform(random), uniform(random));
    const Vector at(uniform(random), uniform(random), uniform(random));
    ObstacleSettings settings{centre, box, {}, {}, {}};
    if (i % 2) settings.shape = Ball{0.1, 150.0, 0.2};
    const Obstacle obstacle(tool, settings);
    if ((at - centre).norm() < 1e-3 || (!(i % 2) && near_an_edge_within(box, at - centre)))
      continue;
    const double d = obstacle.distance(at, 0.0);
    within += d<0.0, beside += d> 0.0 && obstacle.potential(at, 0.0) > 0.0;
    const double h = 1e-5;
    Vector gradient;
    for (int k = 0; k < 3; ++k) {
      const Vector along = h * Vector::Unit(k);
      gradient(k) =
          (obstacle.potential(at + along, 0.0) - obstacle.potential(at - along, 0.0)) / (2.0 * h);
    }
    const Vector c = force(obstacle, at);
    EXPECT_LT((c + gradient).norm(), 1e-5 * (1.0 + c.norm())) << "seed 82, case " << i;
  }
  EXPECT_GT(within, 20);
  EXPECT_GT(beside, 300);
}

// Off a side it is the distance itself, off an edge or a corner it falls short of it by a fourth at most.
TEST(Box, MeasuresTheDistanceFromItsSurface) {
  std::mt19937_64 random(83);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  for (int i = 0; i < 2000; ++i) {
    const Box box = any_box(random);
    const Obstacle obstacle(tool, {Vector::Zero(), box, {}, {}, {}});
    const Vector in_box(uniform(random), uniform(random), uniform(random));
    const Vector nearest = in_box.cwiseMin(0.5 * box.size).cwiseMax(-0.5 * box.size);
    const double true_distance = (in_box - nearest).norm();
    if (true_distance == 0.0) continue;
    const double d = obstacle.distance(box.orientation * in_box, 0.0);
    EXPECT_LE(d, true_distance * (1.0 + 1e-12));
    EXPECT_GE(d, 0.75 * true_distance) << "seed 83, case " << i;
    if (((in_box - nearest).array() != 0.0).count() == 1) {
      EXPECT_NEAR(d, true_distance, 1e-12);
    }
  }
}

TEST(Obstacle, DoesExactlyNothingWhereItIsFar) {
  for (const std::variant<Steering, Ball, Box>& shape :
       {std::variant<Steering, Ball, Box>(Steering{}), {Ball{}}, {Box{}}}) {
    const Obstacle obstacle(tool, {Vector(1.0, 2.0, 3.0), shape, {}, {}, {}});
    for (const Vector& at :
         {Vector(1.41, 2.0, 3.0), Vector(-1e9, 0.0, 1e300), Vector(0.0, 0.0, 0.0)}) {
      Eigen::VectorXd c(3);
      c << 0.1, -0.2, 1e-300;
      const Eigen::VectorXd before = c;
      obstacle.add(at, Vector(0.3, 0.1, 0.2), 0.0, c);
      EXPECT_EQ(c, before);
      EXPECT_EQ(obstacle.potential(at, 0.0), 0.0);
    }
  }
}

// At the reach the force ends with its first two derivatives: its second difference falls with the spacing.
TEST(Obstacle, EndsSmoothlyAtItsReach) {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.5, Vector(1.0, 2.0, 3.0).normalized()));
  const std::pair<std::variant<Steering, Ball, Box>, double> cases[] = {
      {Steering{}, 0.4}, {Ball{}, 0.15}, {Box{}, 0.15}};
  for (const auto& [shape, ends_at] : cases) {
    const Obstacle obstacle(tool, {Vector::Zero(), shape, {}, {}, {}});
    const auto curvature = [&, end = ends_at](double h) {
      const auto at = [&](double x) {
        return force(obstacle, Vector(x, 0.0, 0.0), Vector(-0.4, 0.1, 0.0)).norm();
      };
      return (at(end + 0.5 * h) - 2.0 * at(end - 0.5 * h) + at(end - 1.5 * h)) / (h * h);
    };
    EXPECT_GT(curvature(1e-2), 0.0);
    EXPECT_NEAR(curvature(1e-3) / curvature(5e-4), 2.0, 0.1) << shape.index();
  }
}

// The largest change of ÿ from tick to tick while an obstacle appears, is streamed at 30 Hz by a camera that is out by a
// centimetre, and vanishes.
double largest_change(const std::variant<Steering, Ball, Box>& shape, double dt) {
  std::mt19937_64 random(84);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  const Sequence task = hand();
  Sequencer sequencer(task, Join::dmp2a, task.start_state());
  const auto obstacle = std::make_shared<Obstacle>(
      tool, ObstacleSettings{{0.15, 0.02, 0.0}, shape, Fading{0.1, 0.2}, {}, {}});
  sequencer.add_coupling(obstacle);
  double largest = 0.0;
  const int per_frame = static_cast<int>(std::lround(0.033 / dt));
  for (int k = 1; k * dt < 1.5; ++k) {
    const Eigen::VectorXd before = sequencer.sample().acceleration;
    sequencer.step(dt);
    largest = std::max(largest, (sequencer.sample().acceleration - before).norm());
    const double now = sequencer.motion_time();
    if (k % per_frame == 0) {
      const Eigen::VectorXd seen = sequencer.state().acceleration;
      EXPECT_TRUE(obstacle->move({0.15 + uniform(random), 0.02 + uniform(random), uniform(random)},
                                 now, 0.1));
      EXPECT_TRUE(sequencer.set_goal(sequencer.goal().array() + 1e-9));  // takes C anew
      EXPECT_LT((sequencer.sample().acceleration - seen).norm(), 1e-9);
    }
    if (k == 20 * per_frame) {
      EXPECT_TRUE(obstacle->vanish(now, 0.1));
    }
  }
  EXPECT_EQ(obstacle->presence(sequencer.motion_time()), 0.0);
  return largest;
}

TEST(Obstacle, AppearsMovesAndVanishesWithoutAStep) {
  for (const std::variant<Steering, Ball, Box>& shape :
       {std::variant<Steering, Ball, Box>(Steering{}), {Ball{}}, {Box{}}}) {
    const double coarse = largest_change(shape, 1e-3);
    const double fine = largest_change(shape, 2.5e-4);
    EXPECT_GT(std::log2(coarse / fine) / 2.0, 0.9) << shape.index() << ", seed 84";
    EXPECT_LT(fine, 0.5) << shape.index();
  }
}

// The ends of a reach are smooth enough, wherever they lie between the ticks.
TEST(Obstacle, LeavesTheMotionOfFourthOrderInTheTick) {
  Box box;
  box.size = {0.04, 0.04, 0.04};
  box.orientation = Eigen::AngleAxisd(0.7, Vector(0.0, 0.3, 1.0).normalized());
  for (const std::variant<Steering, Ball, Box>& shape :
       {std::variant<Steering, Ball, Box>(Steering{}), {Ball{}}, {box}}) {
    const Sequence task = hand();
    Sequencer exact(task, Join::dmp2a, task.start_state());
    add_obstacles({{{0.15, 0.03, 0.003}, shape, {}, {}, Moving{{0.15, 0.04, 0.0}, 0.2, 0.5}}},
                  exact);
    Sequencer coarse = exact;
    Sequencer fine = exact;
    Eigen::Vector2d worst(0.0, 0.0);
    for (int k = 0; k < 300; ++k) {
      coarse.step(4e-3);
      for (int i = 0; i < 2; ++i) fine.step(2e-3);
      for (int i = 0; i < 64; ++i) exact.step(4e-3 / 64);
      const Vector y = exact.sample().position;
      worst = worst.cwiseMax(Eigen::Vector2d((coarse.sample().position - y).norm(),
                                             (fine.sample().position - y).norm()));
    }
    EXPECT_NEAR(std::log2(worst(0) / worst(1)), 4.0, 0.4) << shape.index();
    EXPECT_LT(worst(1), 1e-7) << shape.index();
  }
}

// A motion that is faster with everything round it goes the same way.
TEST(Obstacle, AtAnotherSpeedLeavesTheMotionOnItsPath) {
  Sequence slow = hand();
  Sequence fast;
  fast.then(slow.steps()[0].primitive.at_speed(2.0));
  for (const std::variant<Steering, Ball, Box>& shape :
       {std::variant<Steering, Ball, Box>(Steering{}), {Ball{}}, {Box{}}}) {
    const ObstacleSettings settings{{0.15, 0.03, 0.003},
                                    shape,
                                    Fading{0.05, 0.2},
                                    Fading{0.8, 0.1},
                                    Moving{{0.15, 0.05, 0.0}, 0.2, 0.5}};
    Sequencer one(slow, Join::dmp3, slow.start_state());
    Sequencer two(fast, Join::dmp3, fast.start_state());
    add_obstacles({settings}, one);
    add_obstacles({settings.at_speed(2.0)}, two);
    for (int k = 0; k < 1500; ++k) {
      one.step(1e-3);
      two.step(5e-4);
      ASSERT_LT((one.sample().position - two.sample().position).norm(), 1e-12) << shape.index();
    }
  }
}

TEST(Obstacle, IsWhereAndWhenItsSettingsSay) {
  ObstacleSettings settings;
  settings.at = {1.0, 0.0, 0.0};
  settings.appears = Fading{0.5, 0.2};
  settings.vanishes = Fading{2.0, 0.4};
  settings.moves = Moving{{1.0, 2.0, 0.0}, 1.0, 0.5};
  const Obstacle obstacle(tool, settings);
  EXPECT_EQ(obstacle.presence(0.5), 0.0);
  EXPECT_NEAR(obstacle.presence(0.6), 0.5, 1e-12);
  EXPECT_NEAR(obstacle.presence(0.7), 1.0, 1e-15);
  EXPECT_EQ(obstacle.presence(2.0), 1.0);
  EXPECT_NEAR(obstacle.presence(2.2), 0.5, 1e-12);
  EXPECT_EQ(obstacle.presence(9.0), 0.0);
  EXPECT_EQ(obstacle.position(1.0), settings.at);
  EXPECT_LT((obstacle.position(1.25) - Vector(1.0, 1.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(obstacle.position(9.0), Vector(1.0, 2.0, 0.0));
}

TEST(Obstacle, FindsTheToolAmongTheCoordinates) {
  const ObstacleSettings settings{{0.1, 0.0, 0.5}, Ball{}, {}, {}, {}};
  const Obstacle mixed({"rz", "z", "x", "wrist", "y"}, settings);
  Eigen::VectorXd y(5), c = Eigen::VectorXd::Zero(5);
  y << 9.0, 0.5, 0.0, 9.0, 0.02;
  mixed.add(y, Eigen::VectorXd::Zero(5), 0.0, c);
  const Vector expected = force(Obstacle(tool, settings), Vector(0.0, 0.02, 0.5));
  EXPECT_EQ(Vector(c(2), c(4), c(1)), expected);
  EXPECT_EQ(c(0), 0.0);
  EXPECT_EQ(c(3), 0.0);
  const Obstacle plane({"y", "x"}, settings);
  c.setZero(2);
  plane.add(Eigen::Vector2d(0.02, 0.0), Eigen::Vector2d::Zero(), 0.0, c);
  EXPECT_EQ(Eigen::Vector2d(c(1), c(0)), expected.head<2>());
}

TEST(Obstacle, IsRefusedWhereItCannotBe) {
  const auto refused = [](const ObstacleSettings& settings) {
    return test::refusal([&] { Obstacle(tool, settings); });
  };
  EXPECT_EQ(test::refusal([] {
              Obstacle({"j1", "j2"}, ObstacleSettings{});
            }),
            "obstacle: there is no coordinate x among j1, j2, must be a tool's x y z, or x y");
  EXPECT_EQ(refused({Vector(NAN, 0, 0), Ball{}, {}, {}, {}}), "obstacle: at is not finite");
  EXPECT_EQ(refused({Vector::Zero(), Ball{0.0, 1.0, 1.0}, {}, {}, {}}),
            "obstacle: radius 0 m, must be > 0");
  EXPECT_EQ(refused({Vector::Zero(), Ball{1.0, -2.0, 1.0}, {}, {}, {}}),
            "obstacle: strength -2 m/s^2, must be >= 0");
  EXPECT_EQ(refused({Vector::Zero(), Steering{1.0, 1.0, INFINITY}, {}, {}, {}}),
            "obstacle: reach inf m, must be > 0");
  EXPECT_THAT(refused({Vector::Zero(), Steering{1.0, -1.0, 1.0}, {}, {}, {}}),
              HasSubstr("sharpness -1 1/rad"));
  Box box;
  box.size.y() = 0.0;
  EXPECT_EQ(refused({Vector::Zero(), box, {}, {}, {}}), "obstacle: size 0 m, must be > 0");
  box = Box();
  box.orientation.coeffs() *= 1.1;
  EXPECT_EQ(refused({Vector::Zero(), box, {}, {}, {}}),
            "obstacle: orientation has norm 1.1, must be 1");
  EXPECT_THAT(refused({Vector::Zero(), Ball{}, Fading{0.0, 0.0}, {}, {}}),
              HasSubstr("obstacle: appears: "));
  EXPECT_THAT(refused({Vector::Zero(), Ball{}, Fading{1.0, 1.0}, Fading{1.5, 1.0}, {}}),
              HasSubstr("vanishes at 1.5 s, must be after it has appeared"));
  EXPECT_THAT(refused({Vector::Zero(), Ball{}, {}, {}, Moving{{NAN, 0, 0}, 0.0, 1.0}}),
              HasSubstr("moves"));
}

TEST(Obstacle, AllocatesNothingWhileItRuns) {
  const Sequence task = hand();
  Sequencer sequencer(task, Join::dmp2j, task.start_state());
  std::vector<std::shared_ptr<Obstacle>> all;
  for (const std::variant<Steering, Ball, Box>& shape :
       {std::variant<Steering, Ball, Box>(Steering{}), {Ball{}}, {Box{}}}) {
    all.push_back(
        std::make_shared<Obstacle>(tool, ObstacleSettings{{0.15, 0.02, 0.0}, shape, {}, {}, {}}));
    sequencer.add_coupling(all.back());
  }
  const AllocationGuard guard;
  for (int k = 0; k < 1500; ++k) {
    sequencer.step(1e-3);
    for (const auto& one : all) {
      if (k % 33 == 0) one->move({0.15, 1e-4 * k, 0.0}, sequencer.motion_time(), 0.1);
      if (k == 500) one->vanish(sequencer.motion_time(), 0.1);
      if (k == 700) one->appear(sequencer.motion_time(), 0.1);
    }
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
