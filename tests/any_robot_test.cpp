// Arms of every kind, on bases that stand anywhere, held to the bars of the PA-10.

#include <cmath>
#include <optional>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <gmock/gmock.h>

#include "scenes/world.hpp"
#include "tests/kdl_robot.hpp"
#include "tests/random_robot.hpp"
#include "tests/support.hpp"
#include <seam/bullet.hpp>
#include <seam/metrics.hpp>
#include <seam/seam.hpp>

namespace seam {
namespace {

using Eigen::VectorXd;

std::vector<Eigen::Isometry3d> base_poses() {
  std::vector<Eigen::Isometry3d> poses(3, Eigen::Isometry3d::Identity());
  poses[1]
      .translate(Eigen::Vector3d(0.2, 0.1, 2.5))
      .rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  poses[2]
      .translate(Eigen::Vector3d(-1.0, 0.4, 0.9))
      .rotate(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
  return poses;
}

RobotSettings standing(const Eigen::Isometry3d& X_world_base) {
  RobotSettings settings;
  settings.X_world_base = X_world_base;
  settings.self_collision = false;
  return settings;
}

/// A part of the way from the lower to the upper limit; a continuous joint's is a turn.
double part_way(const Joint& joint, double part) {
  const double low = joint.type == Joint::Type::continuous ? -M_PI : joint.lower;
  const double high = joint.type == Joint::Type::continuous ? M_PI : joint.upper;
  return low + part * (high - low);
}

/// Every joint that moves by itself goes from 0.3 of its range to 0.45 and, before it gets there, on to 0.35.
struct Task {
  explicit Task(const RobotModel& robot) : start(robot.neutral()) {
    std::vector<double> to, on;
    for (int i = 0; i < robot.dof(); ++i) {
      const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
      if (joint.follows()) continue;
      names.push_back(joint.name);
      start(i) = part_way(joint, 0.3);
      from.push_back(start(i));
      to.push_back(part_way(joint, 0.45));
      on.push_back(part_way(joint, 0.35));
    }
    robot.place_followers(start);
    sequence.start_after(0.02).then(move(from, to)).until(before_end(0.5)).then(move(to, on));
  }

  Primitive move(const std::vector<double>& a, const std::vector<double>& b) const {
    const Demonstration shape = test::minimum_jerk(1.0, 1.5);
    Demonstration demo{names, shape.time, {}, {}, {}};
    const auto D = static_cast<Eigen::Index>(a.size());
    const Eigen::RowVectorXd first = Eigen::Map<const Eigen::RowVectorXd>(a.data(), D);
    const Eigen::RowVectorXd way = Eigen::Map<const Eigen::RowVectorXd>(b.data(), D) - first;
    demo.position = (shape.position * way).rowwise() + first;
    demo.velocity = shape.velocity * way;
    demo.acceleration = shape.acceleration * way;
    return learn(demo);
  }

  std::vector<std::string> names;
  VectorXd start;
  std::vector<double> from;
  Sequence sequence;
};

Recording play(const RobotModel& model, const Task& task, Join method, double dt,
               const Eigen::Isometry3d& X_world_base) {
  World world;
  Robot robot(model, *world, standing(X_world_base));
  robot.reset(task.start, VectorXd::Zero(model.dof()));
  Controller controller(robot, task.sequence, method);
  Plugin plugin(*world);
  plugin.add(controller);
  std::vector<std::string> names;
  for (const Joint& joint : model.joints) names.push_back(joint.name);
  const int ticks = static_cast<int>(std::lround(3.0 / dt));
  Recording recording(names, VectorXd::Constant(model.dof(), unknown), ticks);
  for (int k = 0; k < ticks; ++k) {
    world->stepSimulation(btScalar(dt), 0);
    const Controller::Tick& tick = controller.last_tick();
    recording.time(k) = k * dt;
    recording.running(k) = tick.running;
    recording.ref.row(k) = tick.reference.position;
    recording.ref_acc.row(k) = tick.reference.acceleration;
    recording.q.row(k) = tick.q;
    recording.qd.row(k) = tick.qd;
    recording.torque.row(k) = tick.torque;
  }
  for (int j = 0; j < controller.sequencer().joins(); ++j)
    recording.joins.push_back({controller.sequencer().join(j).time, j});
  return recording;
}

class AnyRobot : public testing::TestWithParam<std::string> {
 protected:
  static std::string file() {
    return GetParam() == "pa10" ? SEAM_ASSETS "/pa10/pa10.urdf"
                                : SEAM_TEST_DATA "/robots/" + GetParam() + ".urdf";
  }
  RobotModel model_ = RobotModel::read(file());
};

TEST_P(AnyRobot, TracksASequenceExactlyOnAnyBaseWithEveryJoin) {
  const Task task(model_);
  for (const Eigen::Isometry3d& X_world_base : base_poses())
    for (const Join method : all_joins) {
      const Recording run = play(model_, task, method, 2e-3, X_world_base);
      EXPECT_LE((run.ref - run.q).cwiseAbs().maxCoeff(), 1e-9) << to_string(method);
      EXPECT_GT((run.q.colwise().maxCoeff() - run.q.colwise().minCoeff()).minCoeff(), 1e-3);
    }
}

TEST_P(AnyRobot, HandsOverWithoutAStepInTorque) {
  const Task task(model_);
  const Eigen::Isometry3d tilted = base_poses()[2];
  const auto measured = [&](Join method) {
    const Recording half = play(model_, task, method, 5e-4, tilted);
    return measure(play(model_, task, method, 1e-3, tilted), {&half, nullptr});
  };
  const RunMetrics dmp2 = measured(Join::dmp2);
  ASSERT_GE(dmp2.joins.size(), 2U);
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
    const RunMetrics metrics = measured(method);
    EXPECT_LE(metrics.tracking_max_rad, 1e-9) << to_string(method);
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_LE(metrics.joins[j].torque_jump_nm, 0.02 * dmp2.joins[j].torque_jump_nm)
          << to_string(method) << ", join " << j;
      EXPECT_GE(metrics.joins[j].torque_jump_order, 0.9) << to_string(method) << ", join " << j;
    }
  }
}

TEST_P(AnyRobot, AcceleratesAsItsInverseDynamicsAsks) {
  const unsigned seed = 31;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomRobot random(seed);
  double worst = 0.0;
  for (const Eigen::Isometry3d& X_world_base : base_poses()) {
    World world;
    RobotSettings settings = standing(X_world_base);
    settings.colliders = false;
    Robot robot(model_, *world, settings);
    InverseDynamics dynamics(model_);
    dynamics.set_gravity(robot.gravity_in_base());
    const int n = model_.dof();
    VectorXd q(n), qd(n), after(n), torque(n);
    for (int k = 0; k < 1000; ++k) {
      for (int i = 0; i < n; ++i)
        q(i) = part_way(model_.joints[static_cast<std::size_t>(i)], random.uniform(0.0, 1.0));
      qd = random.vector(n, 3.0);
      const VectorXd asked = random.vector(n, 30.0);
      robot.reset(q, qd);
      dynamics.torque(q, qd, asked, torque);
      for (int i = 0; i < n; ++i) robot.multibody().addJointTorque(i, btScalar(torque(i)));
      world->stepSimulation(btScalar(1e-2), 0);
      robot.state(q, after);
      worst = std::max(worst, ((after - qd) / 1e-2 - asked).cwiseAbs().maxCoeff());
    }
  }
  std::printf("worst acceleration error %.2g rad/s^2 or m/s^2\n", worst);
  EXPECT_LE(worst, 1e-9);
}

TEST_P(AnyRobot, HasTheInverseDynamicsOfOrocosKdl) {
  const unsigned seed = 32;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomRobot random(seed);
  std::vector<std::string> names;
  for (const Joint& joint : model_.joints) names.push_back(joint.name);
  const KdlRobot kdl(file());
  InverseDynamics dynamics(model_);
  VectorXd ours(model_.dof());
  for (int k = 0; k < 100; ++k) {
    const VectorXd q = random.vector(model_.dof(), 2.0), qd = random.vector(model_.dof(), 3.0),
                   qdd = random.vector(model_.dof(), 30.0);
    dynamics.torque(q, qd, qdd, ours);
    const VectorXd theirs = kdl.torque(names, q, qd, qdd, {0.0, 0.0, -9.81});
    EXPECT_LE((ours - theirs).cwiseAbs().maxCoeff(), 1e-11 * theirs.cwiseAbs().maxCoeff());
  }
}

INSTANTIATE_TEST_SUITE_P(, AnyRobot,
                         testing::Values("pa10", "six_joint", "gripper_arm", "scara",
                                         "dummy_links"),
                         [](const auto& robot) { return robot.param; });

class Gripper : public testing::Test {
 protected:
  RobotModel model_ = RobotModel::read(SEAM_TEST_DATA "/robots/gripper_arm.urdf");
  Eigen::Index grip_ = model_.joint("grip"), right_ = model_.joint("grip_right"),
               fold_ = model_.joint("fold");

  Primitive grip_to(double goal) const {
    Primitive primitive = learn(test::minimum_jerk(goal, 0.5));
    primitive.coordinates = {"grip"};
    return primitive;
  }
};

TEST_F(Gripper, FingersFollowTheirLeaderThroughAJoin) {
  const Task task(model_);
  const Recording run = play(model_, task, Join::dmp3, 1e-3, base_poses()[2]);
  EXPECT_GT(run.q.col(grip_).maxCoeff() - run.q.col(grip_).minCoeff(), 0.005);
  EXPECT_LE((run.q.col(right_) - run.q.col(grip_)).cwiseAbs().maxCoeff(), 1e-9);
  const VectorXd folded = -15.0 * run.q.col(grip_).array() + 0.2;
  EXPECT_LE((run.q.col(fold_) - folded).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Gripper, BeginsWithItsFollowersInPlace) {
  World world;
  const Robot robot(model_, *world);
  VectorXd q(model_.dof()), qd(model_.dof());
  robot.state(q, qd);
  EXPECT_EQ(q(fold_), 0.2);
  EXPECT_EQ(q, model_.neutral());
}

// The way to the goal leads beyond the leader's limit (0.04 m), at 0.16 m/s.
TEST_F(Gripper, FingersStopTogetherAtALimit) {
  World world;
  Robot robot(model_, *world, standing(base_poses()[0]));
  Demonstration over = test::demonstrate(1.0, [](double t) {
    const double w = 2.0 * M_PI;
    return Eigen::Vector3d(0.025 * (1.0 - std::cos(w * t)), 0.025 * w * std::sin(w * t),
                           0.025 * w * w * std::cos(w * t));
  });
  over.coordinates = {"grip"};
  Controller controller(robot, Sequence().then(learn(over)), Join::dmp3);
  Plugin plugin(*world);
  plugin.add(controller);
  for (int k = 0; k < 1500; ++k) {
    world->stepSimulation(btScalar(1e-3), 0);
    const Controller::Tick& tick = controller.last_tick();
    EXPECT_NEAR(tick.q(right_), tick.q(grip_), 1e-9) << k;
    EXPECT_NEAR(tick.q(fold_), 0.2 - 15.0 * tick.q(grip_), 1e-9) << k;
  }
  EXPECT_EQ(controller.status(), Controller::Status::stopped);
  EXPECT_LT(controller.last_tick().q(grip_), 0.0415);
}

TEST_F(Gripper, FollowersHoldWhereNothingMovesTheirLeader) {
  World world;
  Robot robot(model_, *world, standing(base_poses()[0]));
  Primitive turn = grip_to(0.03);
  turn.coordinates = {"a1"};
  Controller controller(robot, Sequence().then(turn), Join::dmp2);
  Plugin plugin(*world);
  plugin.add(controller);
  for (int k = 0; k < 300; ++k) world->stepSimulation(btScalar(1e-3), 0);
  EXPECT_NEAR(controller.last_tick().q(fold_), 0.2, 1e-9);
  EXPECT_GT(controller.last_tick().q(0), 0.01);
}

TEST_F(Gripper, FollowersThatAreElsewhereComeToTheirPlaceSmoothly) {
  World world;
  Robot robot(model_, *world, standing(base_poses()[2]));
  VectorXd q = model_.neutral();
  q(fold_) = -0.05;
  robot.reset(q, VectorXd::Zero(model_.dof()));
  Controller controller(robot, Sequence().then(grip_to(0.03)), Join::dmp3);
  Plugin plugin(*world);
  plugin.add(controller);
  double hardest = 0.0;
  for (int k = 0; k < 1200; ++k) {
    world->stepSimulation(btScalar(1e-3), 0);
    EXPECT_NEAR(controller.last_tick().q(fold_), controller.last_tick().reference.position(fold_),
                1e-9);
    hardest = std::max(hardest, std::abs(controller.last_tick().reference.acceleration(fold_)));
  }
  EXPECT_LT(hardest, 20.0);
  const VectorXd& now = controller.last_tick().q;
  EXPECT_NEAR(now(fold_), -15.0 * now(grip_) + 0.2, 1e-9);
}

TEST_F(Gripper, StopsAtAGoalThatTakesAFollowerBeyondItsLimits) {
  model_.joints[static_cast<std::size_t>(fold_)].lower = -0.1;
  World world;
  Robot robot(model_, *world, standing(base_poses()[0]));
  Controller controller(robot, Sequence().then(grip_to(0.01)), Join::dmp3);
  Plugin plugin(*world);
  plugin.add(controller);
  for (int k = 0; k < 100; ++k) world->stepSimulation(btScalar(1e-3), 0);
  ASSERT_EQ(controller.status(), Controller::Status::following) << controller.what_happened();
  ASSERT_TRUE(controller.sequencer().set_goal(VectorXd::Constant(1, 0.03)));
  world->stepSimulation(btScalar(1e-3), 0);
  EXPECT_EQ(controller.status(), Controller::Status::stopped);
  EXPECT_EQ(controller.incident().joint, static_cast<int>(fold_)) << controller.what_happened();
}

TEST_F(Gripper, FollowersFollowWhileTheToolMoves) {
  World world;
  Robot robot(model_, *world, standing(base_poses()[1]));
  VectorXd q(model_.dof());
  q << 0.2, 0.5, -0.1, 1.2, 0.1, 0.9, 0.3, 0.02, 0.0, 0.0;
  model_.place_followers(q);
  robot.reset(q, VectorXd::Zero(model_.dof()));
  Kinematics palm(model_, "palm");
  palm.move_to(q);
  Primitive primitive;
  primitive.coordinates = {"x", "y", "z"};
  primitive.start_position = palm.X_base_tool().translation();
  primitive.goal = primitive.start_position + Eigen::Vector3d(0.0, 0.05, -0.05);
  primitive.start_velocity = primitive.start_acceleration = Eigen::Vector3d::Zero();
  primitive.kernels = Kernels::even_in_time(5, 0.75, primitive.alpha);
  primitive.weights.setZero(5, 3);
  ToolSettings tool;
  tool.link = "palm";
  Controller controller(robot, Sequence().then(primitive), Join::dmp3, {{}, tool});
  Plugin plugin(*world);
  plugin.add(controller);
  for (int k = 0; k < 500; ++k) world->stepSimulation(btScalar(1e-3), 0);
  const Controller::Tick& tick = controller.last_tick();
  EXPECT_EQ(controller.status(), Controller::Status::following);
  EXPECT_LE(tick.tool_error.distance, 1e-9);
  EXPECT_NEAR(tick.q(right_), 0.02, 1e-9);
  EXPECT_NEAR(tick.q(fold_), -0.1, 1e-9);
}

TEST_F(Gripper, IsRefusedWhereAFollowerIsMovedByASequenceOrBeyondItsLimits) {
  World world;
  Robot robot(model_, *world);
  const auto refusal = [&](const Primitive& primitive) {
    return test::refusal([&] { Controller(robot, Sequence().then(primitive), Join::dmp2); });
  };
  Primitive primitive = grip_to(0.03);
  primitive.coordinates = {"grip_right"};
  EXPECT_EQ(refusal(primitive),
            R"(joint "grip_right": follows joint "grip", a sequence must move that one)");
  EXPECT_EQ(refusal(grip_to(0.05)),
            R"(joint "grip": goal 0.050000, must be in 0.000000 to 0.040000)");
  model_.joints[static_cast<std::size_t>(fold_)].lower = -0.1;
  const JointSpace space(model_, {"grip"});
  EXPECT_EQ(
      test::refusal([&] { JointSpace(space).require_reachable(grip_to(0.03)); }),
      R"(joint "fold": goal -0.250000 as it follows "grip", must be in -0.100000 to 0.300000)");
  EXPECT_EQ(
      test::refusal([&] { Kinematics(model_, "right_pad"); }),
      R"(link "right_pad": is moved by joint "fold", which follows another; take a link before it)");
}

}  // namespace
}  // namespace seam
