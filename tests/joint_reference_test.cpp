#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <gmock/gmock.h>

#include "scenes/world.hpp"
#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/bullet.hpp>
#include <seam/orientation.hpp>
#include <seam/seam.hpp>

namespace seam {
namespace {

using testing::HasSubstr;

constexpr double dt = 1e-3;

RobotModel arm() {
  return RobotModel::read(std::string(SEAM_ASSETS) + "/pa10/pa10.urdf");
}

Eigen::VectorXd posture() {
  Eigen::VectorXd q(7);
  q << 0.1, 0.4, -0.1, 1.7, 0.2, 1.0, 0.0;
  return q;
}

Eigen::Isometry3d tool_at(const Eigen::VectorXd& q) {
  Kinematics tool(arm(), "tool");
  tool.move_to(q);
  return tool.X_base_tool();
}

ToolSettings hand() {
  ToolSettings tool;
  tool.link = "tool";
  return tool;
}

// A movement of the tool by some vector from where the posture has it: position, and with six coordinates rotation too.
Primitive move(const Eigen::VectorXd& by) {
  const Eigen::Isometry3d X = tool_at(posture());
  Primitive primitive;
  primitive.coordinates = {"x", "y", "z"};
  primitive.goal = primitive.start_position = X.translation();
  if (by.size() == 6) {
    primitive.coordinates.insert(primitive.coordinates.end(), {"rx", "ry", "rz"});
    primitive.goal.conservativeResize(6);
    primitive.goal.tail<3>().setZero();
    primitive.start_position = primitive.goal;
    primitive.reference_orientation = Eigen::Quaterniond(X.linear()).normalized();
  }
  primitive.goal += by;
  primitive.kernels = Kernels::even_in_time(5, 0.75, primitive.alpha);
  primitive.weights.setConstant(5, by.size(), 10.0);
  primitive.start_velocity = primitive.start_acceleration = Eigen::VectorXd::Zero(by.size());
  return primitive;
}

Sequence there_and_back(const Eigen::VectorXd& by) {
  Sequence task;
  task.start_after(0.02).then(move(by)).until(before_end(0.5)).then(move(-by));
  return task;
}

Eigen::VectorXd six() {
  Eigen::VectorXd by(6);
  by << 0.08, -0.1, 0.06, 0.3, -0.2, 0.25;
  return by;
}

struct App {
  World world;
  Robot robot{arm(), *world};
  std::optional<Controller> controller;
  std::optional<Plugin> plugin;

  App(const Sequence& task, Join join, ControllerSettings settings) {
    robot.reset(posture(), Eigen::VectorXd::Zero(7));
    controller.emplace(robot, task, join, settings);
    plugin.emplace(*world);
    plugin->add(*controller);
  }
  const Controller::Tick& step() {
    world->stepSimulation(dt, 0);
    return controller->last_tick();
  }
};

TEST(TaskSpace, ToolFollowsPositionAndOrientationExactly) {
  for (const Eigen::VectorXd& by : {Eigen::VectorXd(six().head(3)), six()}) {
    App app(there_and_back(by), Join::dmp3, {{}, hand()});
    double farthest = 0.0;
    const Eigen::Vector3d start = tool_at(posture()).translation();
    while (!app.controller->finished()) {
      const Controller::Tick& tick = app.step();
      EXPECT_LT(tick.tool_error.distance, 1e-9);
      EXPECT_LT(tick.tool_error.angle, 1e-9);
      // The same by kinematics of our own and the multibody's state.
      const Eigen::Isometry3d X = tool_at(tick.q);
      ASSERT_LT((X.translation() - tick.sequence.position.head(3)).norm(), 1e-9);
      farthest = std::max(farthest, (X.translation() - start).norm());
    }
    EXPECT_GT(farthest, 0.05);
  }
}

TEST(TaskSpace, KeepsTheOrientationThatTheSequenceDoesNotTurn) {
  App app(there_and_back(six().head(3)), Join::dmp2, {{}, hand()});
  const Eigen::Quaterniond start(tool_at(posture()).linear());
  while (!app.controller->finished()) {
    const Eigen::Quaterniond now(tool_at(app.step().q).linear());
    EXPECT_LT(now.angularDistance(start), 1e-7);
  }
}

// Position, velocity and acceleration of the joints belong together: central differences of order dt².
TEST(TaskSpace, JointVelocitiesAndAccelerationsAreTheDerivatives) {
  const Sequence task = there_and_back(six());
  TaskSpace space(arm(), task, hand(), posture());
  Sequencer sequencer(task, Join::dmp3, space.measured(posture(), Eigen::VectorXd::Zero(7)));
  std::vector<Sample> joints;
  for (int k = 0; k < 400; ++k) {
    Sample sample(7);
    ASSERT_TRUE(space.find(sequencer.sample(), sample));
    joints.push_back(sample);
    sequencer.step(dt);
  }
  for (std::size_t k = 100; k + 1 < joints.size(); ++k) {
    const Eigen::VectorXd slope = (joints[k + 1].position - joints[k - 1].position) / (2.0 * dt);
    const Eigen::VectorXd bend =
        (joints[k + 1].position - 2.0 * joints[k].position + joints[k - 1].position) / (dt * dt);
    EXPECT_LT((slope - joints[k].velocity).cwiseAbs().maxCoeff(), 2e-4);
    EXPECT_LT((bend - joints[k].acceleration).cwiseAbs().maxCoeff(), 2e-3);
  }
}

TEST(TaskSpace, SaysHowFarTheToolIsFromAnySample) {
  for (const Eigen::VectorXd& by : {Eigen::VectorXd(six().head(3)), six()}) {
    const Sequence task = there_and_back(by);
    TaskSpace space(arm(), task, hand(), posture());
    Sample here = space.measured(posture(), Eigen::VectorXd::Zero(7));
    Sample there = here;
    there.position += 0.1 * by;
    Sample joints(7);
    const auto miss_is = [&](double share) {
      const ToolError none = space.miss(here, posture());
      EXPECT_LT(none.distance, 1e-12) << share;
      EXPECT_LT(none.angle, 1e-12) << share;
      const ToolError some = space.miss(there, posture());
      EXPECT_NEAR(some.distance, share * by.head(3).norm(), 1e-12);
      EXPECT_NEAR(some.angle, by.size() == 6 ? share * by.tail(3).norm() : 0.0, 1e-12);
    };
    miss_is(0.1);
    ASSERT_TRUE(space.find(there, joints));
    miss_is(0.1);
    ASSERT_TRUE(space.find(here, joints));
    miss_is(0.1);
    there.position += 5.0 * by;
    EXPECT_FALSE(space.find(there, joints));
    miss_is(5.1);
  }
}

TEST(TaskSpace, GoalOutOfReachStopsTheArmSmoothly) {
  App app(there_and_back(six().head(3)), Join::dmp3, {{}, hand()});
  for (int k = 0; k < 200; ++k) app.step();
  ASSERT_TRUE(app.controller->sequencer().set_goal(Eigen::Vector3d(2.0, 0.0, 0.5)));
  double largest_step = 0.0;
  double largest = 0.0;
  Eigen::VectorXd before = app.step().reference.acceleration;
  for (int k = 0; k < 3000; ++k) {
    const Controller::Tick& tick = app.step();
    ASSERT_TRUE(tick.torque.allFinite());
    largest_step =
        std::max(largest_step, (tick.reference.acceleration - before).cwiseAbs().maxCoeff());
    before = tick.reference.acceleration;
    largest = std::max(largest, before.cwiseAbs().maxCoeff());
  }
  EXPECT_EQ(app.controller->status(), Controller::Status::stopped);
  EXPECT_LT(app.controller->last_tick().qd.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(largest_step, 0.2 * largest);
  EXPECT_GT(app.controller->last_tick().tool_error.distance, 0.1);
}

TEST(TaskSpace, RefusesWhatItCannotPlay) {
  World world;
  Robot robot(arm(), *world);
  robot.reset(posture(), Eigen::VectorXd::Zero(7));
  const auto refused = [&](const Sequence& task, const ToolSettings& tool) {
    return test::refusal([&] { Controller(robot, task, Join::dmp3, {{}, tool}); });
  };
  const Sequence task = there_and_back(six().head(3));
  EXPECT_THAT(refused(there_and_back(Eigen::Vector3d(1.5, 0.0, 0.0)), hand()),
              HasSubstr("out of reach by "));
  Primitive strange = move(six().head(3));
  strange.coordinates = {"x", "y", "w"};
  EXPECT_THAT(refused(Sequence().then(strange), hand()),
              HasSubstr("other coordinates than a tool's x y z or x y z rx ry rz"));
  Primitive aimless = move(six());
  aimless.reference_orientation.reset();
  EXPECT_THAT(refused(Sequence().then(aimless), hand()), HasSubstr("no reference orientation"));
  ToolSettings tool = hand();
  tool.link = "spoon";
  EXPECT_THAT(refused(task, tool), HasSubstr("spoon"));
  tool = hand();
  tool.posture.rest = Eigen::VectorXd::Zero(7);
  EXPECT_THAT(refused(task, tool), HasSubstr("not where the posture puts them"));
}

TEST(TaskSpace, ReachPutsTheJointsWhereASequenceCanBegin) {
  World world;
  Robot robot(arm(), *world);
  ToolSettings tool = hand();
  tool.posture.rest = Eigen::VectorXd::Zero(7);
  tool.orientation = Eigen::Quaterniond(tool_at(posture()).linear());
  const Sequence task = there_and_back(six().head(3));
  TaskSpace space(arm(), task, tool, posture());
  const Eigen::VectorXd q = space.reach(tool_at(posture()));
  EXPECT_GT((q - posture()).norm(), 0.01);
  robot.reset(q, Eigen::VectorXd::Zero(7));
  const Controller controller(robot, task, Join::dmp3, {{}, tool});
  EXPECT_LT((controller.last_tick().q - q).norm(), 1e-12);
}

TEST(TaskSpace, TickAllocatesNothingThroughAJoinAndAChangeOfGoal) {
  for (const Join method : all_joins) {
    App app(there_and_back(six()), method, {{}, hand()});
    const Eigen::VectorXd goal = app.controller->sequencer().goal() + 0.02 * six();
    app.plugin->remove(*app.controller);
    long allocations = 0;
    for (int k = 0; k < 800; ++k) {
      const AllocationGuard guard;
      if (k == 700) app.controller->sequencer().set_goal(goal);
      app.controller->pre_tick(dt);
      allocations += guard.allocations();
      app.world->stepSimulation(dt, 0);
    }
    EXPECT_EQ(allocations, 0) << to_string(method);
    EXPECT_EQ(app.controller->sequencer().joins(), 2) << to_string(method);
    EXPECT_EQ(app.controller->status(), Controller::Status::following) << to_string(method);
  }
}

TEST(Controller, RefusesAModelOfOtherJoints) {
  World world;
  Robot robot(arm(), *world);
  RobotModel other = arm();
  other.joints[2].name = "S9";
  EXPECT_THAT(test::refusal([&] {
                Controller(robot, there_and_back(six().head(3)), Join::dmp3, {{}, hand(), other});
              }),
              HasSubstr("not the robot's first ones"));
}

}  // namespace
}  // namespace seam
