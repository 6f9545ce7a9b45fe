// What apps do to a world in which arms play: nothing of it may make an arm miss its reference, or crash.

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <random>
#include <thread>

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>
#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/elbow.hpp"

namespace seam {
namespace {

using test::App;
using test::Arm;
using test::bent;
using test::elbow_task;
using test::ramp;
using test::tracking_error;

// Arms

struct Player {
  Arm arm;
  Controller controller;

  Player(World& world, const RobotSettings& settings)
      : arm(world, settings), controller(arm.robot, elbow_task(), Join::dmp3) {}
};

TEST(AnyApp, AddsAndRemovesArmsWhileTheWorldRuns) {
  World world;
  Plugin plugin(*world);
  std::map<int, Player> players;
  std::mt19937 random(7);
  for (int k = 0; k < 1500; ++k) {
    if (k % 50 == 0 && k <= 700) {
      RobotSettings place;
      place.X_world_base = Eigen::Translation3d(3.0 * (k / 50), 0.0, 0.0) *
                           Eigen::AngleAxisd(0.2 * (k / 50), Eigen::Vector3d::UnitX());
      plugin.add(players.try_emplace(k, world, place).first->second.controller);
    }
    if (k % 70 == 69 && players.size() > 1)
      players.erase(std::next(players.begin(), static_cast<int>(random() % players.size())));
    world->stepSimulation(1e-3, 0);
    for (const auto& [begun, player] : players)
      ASSERT_LT(tracking_error(player.controller), 1e-9) << begun << " at " << k;
  }
  players.clear();
  EXPECT_EQ(world->getNumMultibodies(), 0);
  EXPECT_EQ(world->getNumCollisionObjects(), 1);  // the plugin's
}

// Ends of life

using Owned = std::unique_ptr<void, void (*)(void*)>;

template <typename T, typename... Arguments>
Owned own(Arguments&&... arguments) {
  return {new T(std::forward<Arguments>(arguments)...),
          [](void* thing) { delete static_cast<T*>(thing); }};
}

// All orders in which a world, a robot with its controller before it, and a plugin can go.
TEST(AnyApp, DestroysWorldRobotAndPluginInAnyOrder) {
  std::array<int, 3> order{0, 1, 2};
  do {
    std::array<Owned, 3> things{own<World>(), Owned(nullptr, nullptr), Owned(nullptr, nullptr)};
    World& world = *static_cast<World*>(things[0].get());
    things[1] = own<Player>(world, RobotSettings());
    things[2] = own<Plugin>(*world);
    static_cast<Plugin*>(things[2].get())->add(static_cast<Player*>(things[1].get())->controller);
    for (int k = 0; k < 3; ++k) world->stepSimulation(1e-3, 0);
    for (const int next : order) {
      things[static_cast<std::size_t>(next)].reset();
      if (things[0]) world->stepSimulation(1e-3, 0);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(AnyApp, DestroysTheWorldBeforeTheControllerAndTheReverse) {
  for (const bool world_first : {true, false}) {
    auto world = std::make_unique<World>();
    auto player = std::make_unique<Player>(*world, RobotSettings());
    Plugin plugin(**world);
    plugin.add(player->controller);
    (*world)->stepSimulation(1e-3, 0);
    if (world_first) world.reset();
    player.reset();
    world.reset();
  }
}

TEST(AnyApp, LeavesAWorldThatItDestroysAfterTheRobotEmpty) {
  World world;
  { Player player(world, {}); }
  EXPECT_EQ(world->getNumMultibodies(), 0);
  EXPECT_EQ(world->getNumCollisionObjects(), 0);
}

// Steps

TEST(AnyApp, StepsByTimesThatVary) {
  App app(elbow_task());
  std::mt19937 random(3);
  double farthest = 0.0;
  while (!app.controller.finished()) {
    app.step(5e-4 + 3.5e-3 * static_cast<double>(random() % 1000) / 1000.0);
    farthest = std::max(farthest, tracking_error(app.controller));
  }
  EXPECT_LT(farthest, 5e-4);
  for (int k = 0; k < 500; ++k) app.step(2e-3);
  EXPECT_LT(tracking_error(app.controller), 1e-6);
}

// As a game does: frames of any length, of which Bullet makes ticks of one.
TEST(AnyApp, StepsByFramesWithSubsteps) {
  App app(elbow_task());
  std::mt19937 random(5);
  double farthest = 0.0;
  while (!app.controller.finished()) {
    const double frame = 0.005 + 0.03 * static_cast<double>(random() % 1000) / 1000.0;
    app.world->stepSimulation(frame, 50, 1e-3);
    farthest = std::max(farthest, tracking_error(app.controller));
  }
  EXPECT_LT(farthest, 1e-9);
}

// Resets and teleports

Eigen::VectorXd elsewhere() {
  Eigen::VectorXd q = bent();
  q(0) += 0.7;
  q(3) += 0.5;
  q(5) -= 0.4;
  return q;
}

TEST(AnyApp, TeleportsTheArmAndGoesOnFromThere) {
  for (const Join method : all_joins) {
    App app(elbow_task(), {}, method);
    for (const double at : {0.03, 0.3, 0.7, 1.5}) {  // waiting, in both movements, and at the end
      while (app.controller.last_tick().time < at) app.step();
      Eigen::VectorXd qd = Eigen::VectorXd::Zero(7);
      qd(3) = 0.4;
      qd(1) = -0.5;
      app.arm.robot.reset(elsewhere(), qd);
      ASSERT_TRUE(app.controller.reinitialise());
      for (int k = 0; k < 100; ++k) {
        app.step();
        ASSERT_LT(tracking_error(app.controller), 1e-9) << to_string(method) << " " << at;
      }
      EXPECT_EQ(app.controller.status(), Controller::Status::following);
    }
    app.play(2.5);
    EXPECT_NEAR(app.q()(3), 0.9, 0.02) << to_string(method);
    EXPECT_NEAR(app.q()(0), elsewhere()(0), 1e-9) << "is not named, and stays";
  }
}

TEST(AnyApp, TeleportsTheArmAwayAndSaysNothingToTheController) {
  App app(elbow_task());
  app.play(0.3);
  app.arm.robot.reset(elsewhere(), Eigen::VectorXd::Zero(7));
  app.step();
  EXPECT_EQ(app.controller.status(), Controller::Status::stopped);
  EXPECT_EQ(app.controller.incident().cause, Incident::Cause::deviation);
  app.play(0.5);
  EXPECT_LT((app.q() - elsewhere()).norm(), 1e-6) << "stays where it was put";
}

Eigen::VectorXd in_mid_reach() {
  Eigen::VectorXd q(7);
  q << 0.1, 0.4, -0.1, 1.7, 0.2, 1.0, 0.0;
  return q;
}

Sequence reach_forward(const Robot& robot) {
  Kinematics tool(robot.model(), "tool");
  tool.move_to(in_mid_reach());
  Primitive reach;
  reach.coordinates = {"x", "y", "z"};
  reach.start_position = tool.X_base_tool().translation();
  reach.goal = reach.start_position + Eigen::Vector3d(0.08, -0.1, 0.06);
  reach.kernels = Kernels::even_in_time(5, 0.75, reach.alpha);
  reach.weights.setConstant(5, 3, 10.0);
  reach.start_velocity = reach.start_acceleration = Eigen::VectorXd::Zero(3);
  return Sequence().then(reach);
}

// The arm is put in a posture in which it would not be by itself; what the tool is off by that fades within a second.
TEST(AnyApp, TeleportsTheArmInTaskSpaceToAnotherPosture) {
  World world;
  Arm arm(world);
  arm.robot.reset(in_mid_reach(), Eigen::VectorXd::Zero(7));
  ToolSettings hand;
  hand.link = "tool";
  Controller controller(arm.robot, reach_forward(arm.robot), Join::dmp3, {{}, hand});
  Plugin plugin(*world);
  plugin.add(controller);
  for (int k = 0; k < 300; ++k) world->stepSimulation(1e-3, 0);
  Eigen::VectorXd q = controller.last_tick().q;
  q(2) += 0.25;
  q(4) -= 0.2;
  arm.robot.reset(q, Eigen::VectorXd::Zero(7));
  const AllocationGuard guard;
  const bool taken_up = controller.reinitialise();
  EXPECT_EQ(guard.allocations(), 0);
  ASSERT_TRUE(taken_up);
  Eigen::VectorXd before = q;
  for (int k = 0; k < 2500; ++k) {
    world->stepSimulation(1e-3, 0);
    const Controller::Tick& tick = controller.last_tick();
    ASSERT_LT(tracking_error(controller), 1e-9) << k;
    ASSERT_LT((tick.reference.position - before).cwiseAbs().maxCoeff(), 2e-3) << k;
    before = tick.reference.position;
    ASSERT_LT(k > 1002 ? tick.tool_error.distance : 0.0, 1e-9) << k;
  }
  EXPECT_EQ(controller.status(), Controller::Status::following);
  Kinematics tool(arm.robot.model(), "tool");
  tool.move_to(controller.last_tick().q);
  EXPECT_LT((tool.X_base_tool().translation() - controller.sequencer().goal()).norm(), 1e-3);
}

TEST(AnyApp, ReinitialisesWithoutAllocating) {
  App app(elbow_task());
  app.play(0.3);
  const AllocationGuard guard;
  EXPECT_TRUE(app.controller.reinitialise());
  EXPECT_EQ(guard.allocations(), 0);
}

// Constraints and contacts

TEST(AnyApp, HangsALoadOnTheArmAndTakesItAway) {
  App app(elbow_task());
  btBoxShape shape(btVector3(0.05, 0.05, 0.05));
  btRigidBody load(
      btRigidBody::btRigidBodyConstructionInfo(0.5, nullptr, &shape, btVector3(1e-3, 1e-3, 1e-3)));
  const Eigen::Isometry3d X = app.arm.robot.X_world_frame(app.arm.robot.model().frame("tool"));
  const btVector3 at(X(0, 3), X(1, 3), X(2, 3) - 0.3);
  load.setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
  app.world->addRigidBody(&load);
  const btTransform link = app.arm.robot.multibody().getLink(6).m_cachedWorldTransform;
  const btVector3 hook = at + btVector3(0, 0, 0.3);
  btMultiBodyPoint2Point rope(&app.arm.robot.multibody(), 6, &load, link.inverse() * hook,
                              btVector3(0, 0, 0.3));
  app.world->addMultiBodyConstraint(&rope);
  double farthest = 0.0;
  for (int k = 0; k < 500; ++k) {
    app.step();
    farthest = std::max(farthest, tracking_error(app.controller));
  }
  EXPECT_GT(farthest, 1e-4) << "the load is felt";
  EXPECT_LT(farthest, 0.1);
  app.world->removeMultiBodyConstraint(&rope);
  app.world->removeRigidBody(&load);
  app.play(1.5);
  EXPECT_EQ(app.controller.status(), Controller::Status::following);
  EXPECT_LT(tracking_error(app.controller), 1e-7);
}

// A motor that the app holds a joint with, which the sequence does not name.
TEST(AnyApp, DrivesAJointByAMotorOfItsOwn) {
  App app(elbow_task());
  btMultiBodyJointMotor motor(&app.arm.robot.multibody(), 6, 0.0, 1e3);
  app.world->addMultiBodyConstraint(&motor);
  double farthest = 0.0;
  while (!app.controller.finished()) {
    app.step();
    farthest = std::max(farthest, tracking_error(app.controller));
  }
  app.world->removeMultiBodyConstraint(&motor);
  EXPECT_LT(farthest, 1e-6) << "both want the joint to stand still";
}

Eigen::Vector3d tool_at(const App& app, double elbow) {
  Kinematics tool(app.arm.robot.model(), "tool");
  Eigen::VectorXd q = bent();
  q(3) = elbow;
  tool.move_to(q);
  return tool.X_base_tool().translation();
}

TEST(AnyApp, PushesABoxOutOfTheWay) {
  const auto pushed = [](bool box) {
    App app(elbow_task());
    btBoxShape shape(btVector3(0.05, 0.05, 0.05));
    btVector3 inertia;
    shape.calculateLocalInertia(0.3, inertia);
    btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(0.3, nullptr, &shape, inertia));
    const Eigen::Vector3d start = tool_at(app, 0.8);
    const Eigen::Vector3d way = tool_at(app, 1.1) - start;
    const Eigen::Vector3d ahead = start + 0.5 * way + 0.12 * way.normalized();
    body.setWorldTransform(
        btTransform(btQuaternion::getIdentity(), btVector3(ahead.x(), ahead.y(), ahead.z())));
    body.setGravity(btVector3(0, 0, 0));
    body.setFlags(BT_DISABLE_WORLD_GRAVITY);
    if (box) app.world->addRigidBody(&body);
    double farthest = 0.0;
    while (!app.controller.finished()) {
      app.step();
      farthest = std::max(farthest, tracking_error(app.controller));
    }
    app.play(1.0);
    EXPECT_EQ(app.controller.status(), Controller::Status::following);
    EXPECT_LT(tracking_error(app.controller), 1e-6);
    if (box) {
      EXPECT_GT(body.getLinearVelocity().length(), 0.01);
      app.world->removeRigidBody(&body);
    }
    return farthest;
  };
  EXPECT_LT(pushed(false), 1e-9);
  const double farthest = pushed(true);
  EXPECT_GT(farthest, 1e-5) << "the box is felt";
  EXPECT_LT(farthest, 0.05);
}

// Threads

Eigen::MatrixXd positions(int arm) {
  Sequence task;
  const double there = 0.9 + 0.02 * arm;
  task.then(learn(ramp("E1", 0.8, there))).then(learn(ramp("E1", there, 0.85)));
  App app(task, {}, all_joins[static_cast<std::size_t>(arm) % all_joins.size()]);
  Eigen::MatrixXd q(300, 7);
  for (int k = 0; k < q.rows(); ++k) q.row(k) = app.step().q;
  return q;
}

TEST(AnyApp, RunsWorldsInParallelToTheSameBits) {
  constexpr std::size_t count = 8;
  std::vector<Eigen::MatrixXd> alone(count), together(count);
  for (std::size_t i = 0; i < count; ++i) alone[i] = positions(static_cast<int>(i));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i)
    threads.emplace_back([&, i] { together[i] = positions(static_cast<int>(i)); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(alone[i] == together[i]) << i;
}

}  // namespace
}  // namespace seam
