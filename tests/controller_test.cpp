#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <gmock/gmock.h>

#include "scenes/world.hpp"
#include "tests/allocation_guard.hpp"
#include "tests/elbow.hpp"
#include "tests/support.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

namespace seam {
namespace {

using test::Arm;
using test::bent;
using test::elbow_task;
using test::ramp;

double worst_tracking(double dt, const ControlSettings& control,
                      const RobotSettings& settings = {}) {
  World world;
  Arm arm(world, settings);
  Controller controller(arm.robot, elbow_task(), Join::dmp2, control);
  Plugin plugin(*world);
  plugin.add(controller);
  double worst = 0.0;
  while (!controller.finished()) {
    world->stepSimulation(dt, 0);
    const Controller::Tick& tick = controller.last_tick();
    worst = std::max(worst, (tick.reference.position - tick.q).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(Controller, TracksExactlyWithTheMatchedReference) {
  for (const double dt : {5e-4, 1e-3, 4e-3}) EXPECT_LT(worst_tracking(dt, {}), 1e-9) << dt;
}

TEST(Controller, TracksExactlyOnATiltedBase) {
  RobotSettings settings;
  settings.X_world_base = Eigen::Translation3d(1.0, -2.0, 0.5) *
                          Eigen::AngleAxisd(2.1, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
  EXPECT_LT(worst_tracking(1e-3, {}, settings), 1e-9);
}

TEST(Controller, LeavesAnErrorOfOrderDtWithThePlainReference) {
  ControlSettings plain;
  plain.reference = ControlSettings::Reference::plain;
  const double coarse = worst_tracking(2e-3, plain);
  const double fine = worst_tracking(1e-3, plain);
  EXPECT_GT(fine, 1e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.2);
}

TEST(Controller, IsTheOnlyOneOfItsRobot) {
  World world;
  Arm arm(world);
  {
    const Controller first(arm.robot, elbow_task(), Join::dmp2);
    EXPECT_EQ(test::refusal([&] { Controller(arm.robot, elbow_task(), Join::dmp3); }),
              "pa10: has a controller already, whose torques those of another would add to");
    EXPECT_THROW(Controller(arm.robot, elbow_task(), Join::dmp3), Error);  // still
  }
  EXPECT_NO_THROW(Controller(arm.robot, elbow_task(), Join::dmp3));
  EXPECT_THROW(Controller(arm.robot, Sequence(), Join::dmp3), Error);
  EXPECT_NO_THROW(
      Controller(arm.robot, elbow_task(), Join::dmp3));  // one that failed leaves nothing
}

TEST(Controller, RecoversFromAPush) {
  World world;
  Arm arm(world);
  Controller controller(arm.robot, elbow_task(), Join::dmp3);
  Plugin plugin(*world);
  plugin.add(controller);
  while (controller.last_tick().time < 0.2) world->stepSimulation(1e-3, 0);
  for (int i = 0; i < 20; ++i) {
    arm.robot.multibody().addJointTorque(3, 40.0);
    world->stepSimulation(1e-3, 0);
  }
  const auto error = [&] {
    return std::abs(controller.last_tick().reference.position(3) - controller.last_tick().q(3));
  };
  const double pushed = error();
  EXPECT_GT(pushed, 1e-3);
  for (int i = 0; i < 1000; ++i) world->stepSimulation(1e-3, 0);
  EXPECT_LT(error(), 1e-4 * pushed);
}

TEST(Controller, JointsThatAreNotNamedHoldTheirPosition) {
  World world;
  Arm arm(world);
  Controller controller(arm.robot, elbow_task(), Join::dmp2a);
  Plugin plugin(*world);
  plugin.add(controller);
  while (!controller.finished()) world->stepSimulation(1e-3, 0);
  for (const int i : {0, 1, 2, 4, 5, 6})
    EXPECT_NEAR(controller.last_tick().q(i), bent()(i), 1e-9) << i;
  EXPECT_NEAR(controller.last_tick().q(3), 0.9, 0.05);
}

// Several joints, in another order than the robot's, from a state that moves.
TEST(Controller, FindsItsJointsByNameAndStartsInMotion) {
  World world;
  Arm arm(world);
  Demonstration demo = ramp("W1", 0.6, 0.2);
  const Demonstration other = ramp("S2", 0.5, 0.8);
  demo.coordinates = {"W1", "S2"};
  for (auto [to, from] : {std::pair{&demo.position, &other.position},
                          {&demo.velocity, &other.velocity},
                          {&demo.acceleration, &other.acceleration}}) {
    to->conservativeResize(Eigen::NoChange, 2);
    to->col(1) = *from;
  }
  Eigen::VectorXd qd = Eigen::VectorXd::Zero(7);
  qd(1) = 0.3;
  qd(5) = -0.4;
  arm.robot.reset(bent(), qd);
  Controller controller(arm.robot, Sequence().then(learn(demo)), Join::dmp2a);
  Plugin plugin(*world);
  plugin.add(controller);
  double worst = 0.0;
  while (!controller.finished()) {
    world->stepSimulation(1e-3, 0);
    const Controller::Tick& tick = controller.last_tick();
    worst = std::max(worst, (tick.reference.position - tick.q).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_NEAR(controller.last_tick().q(5), 0.2, 0.05);
  EXPECT_NEAR(controller.last_tick().q(1), 0.8, 0.05);
}

TEST(Controller, DoesNothingInATickOfNoLength) {
  World world;
  Arm arm(world);
  Controller controller(arm.robot, elbow_task(), Join::dmp2a);
  controller.pre_tick(0.0);
  controller.pre_tick(-1.0);
  controller.pre_tick(1e-3);
  EXPECT_TRUE(controller.last_tick().torque.allFinite());
}

// The state after a while of steps that the world divides as it is told.
Eigen::VectorXd played_with_substeps(double step, int max_substeps, double fixed) {
  World world;
  Arm arm(world);
  Controller controller(arm.robot, elbow_task(), Join::dmp3);
  Plugin plugin(*world);
  plugin.add(controller);
  for (double t = 0.0; t < 416.0 * fixed; t += step)
    world->stepSimulation(step, max_substeps, fixed);
  Eigen::VectorXd state(14);
  arm.robot.state(state.head(7), state.tail(7));
  return state;
}

TEST(Controller, SubstepsGiveTheSameMotionAsSingleSteps) {
  const double fixed = 0x1p-10;  // [s] a power of two, so that Bullet's clock adds it up exactly
  const Eigen::VectorXd single = played_with_substeps(fixed, 0, fixed);
  EXPECT_LT((played_with_substeps(4.0 * fixed, 4, fixed) - single).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((played_with_substeps(8.0 * fixed, 10, fixed) - single).cwiseAbs().maxCoeff(), 1e-10);
}

// An app that owns the tick callback, adds torques of its own, and looks at what Bullet is given.
struct App {
  World world;
  Arm arm{world};
  Controller controller{arm.robot, elbow_task(), Join::dmp3};
  double worst = 0.0;
  int ticks = 0;

  App() { world->setInternalTickCallback(&App::tick, this, true); }
  ~App() { world->setInternalTickCallback(nullptr, nullptr, true); }
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  static double own_torque(int joint) { return 0.7 * (joint + 1); }
  void add_own_torque() {
    arm.robot.multibody().addBaseTorque(btVector3(5.0, 0.0, 0.0));

    for (int i = 0; i < 7; ++i) arm.robot.multibody().addJointTorque(i, own_torque(i));
  }
  static void tick(btDynamicsWorld* world, btScalar dt) {
    App& app = *static_cast<App*>(world->getWorldUserInfo());
    app.controller.pre_tick(dt);
    ++app.ticks;
    for (int i = 0; i < 7; ++i) {
      const double rest =
          app.arm.robot.multibody().getJointTorque(i) - app.controller.last_tick().torque(i);
      app.worst = std::max(app.worst, std::abs(rest - own_torque(i)));
    }
  }
};

TEST(Controller, AnAppsOwnTorquesSurviveWithAndWithoutSubsteps) {
  for (const int substeps : {0, 1, 4}) {
    App app;
    for (int k = 0; k < 200; ++k) {
      app.add_own_torque();
      app.world->stepSimulation(1e-3 * std::max(1, substeps), substeps, 1e-3);
    }
    EXPECT_GE(app.ticks, 199 * std::max(1, substeps)) << substeps;
    EXPECT_LT(app.worst, 1e-11) << substeps;
  }
}

TEST(Controller, TicksWithoutAllocatingThroughJoinsAndChangesOfGoal) {
  for (const Join method : all_joins) {
    World world;
    Arm arm(world);
    Controller controller(arm.robot, elbow_task(), method);
    const Eigen::VectorXd goal = Eigen::VectorXd::Constant(1, 1.2);
    long allocations = 0;
    for (int k = 0; !controller.finished(); ++k) {
      const AllocationGuard guard;
      if (k == 200) controller.sequencer().set_goal(goal);
      controller.pre_tick(1e-3);
      allocations += guard.allocations();
      world->stepSimulation(1e-3, 0);
    }
    EXPECT_EQ(allocations, 0) << to_string(method);
    EXPECT_EQ(controller.status(), Controller::Status::following) << controller.what_happened();
  }
}

TEST(Controller, ReferenceFollowsAChangeBetweenTicks) {
  World world;
  Arm arm(world);
  Controller controller(arm.robot, elbow_task(), Join::dmp2);
  for (int k = 0; k < 200; ++k) {
    controller.pre_tick(1e-3);
    world->stepSimulation(1e-3, 0);
  }
  const double before = controller.sequencer().sample().acceleration(0);
  controller.sequencer().set_goal(Eigen::VectorXd::Constant(1, 1.2));
  const double changed = controller.sequencer().sample().acceleration(0);
  ASSERT_GT(std::abs(changed - before), 1.0);
  controller.pre_tick(1e-3);
  EXPECT_EQ(controller.last_tick().sequence.acceleration(0), changed);
  EXPECT_EQ(controller.last_tick().reference.acceleration(3), changed);
}

TEST(Controller, RefusesWhatItCannotPlay) {
  World world;
  Arm arm(world);
  const auto refused = [&](const Sequence& sequence, const ControlSettings& control = {}) {
    return test::refusal([&] { Controller(arm.robot, sequence, Join::dmp3, control); });
  };
  EXPECT_THAT(refused(Sequence().then(learn(ramp("elbow", 0.0, 1.0)))),
              testing::HasSubstr("\"elbow\""));
  EXPECT_THAT(refused(Sequence().then(learn(ramp("E1", 0.0, 3.0)))),
              testing::StartsWith("joint \"E1\": goal 3.000000, must be in -2.391"));
  EXPECT_EQ(refused(Sequence()), "sequence: empty, must have at least one primitive");
  ControlSettings control;
  control.Kd = NAN;
  EXPECT_EQ(refused(elbow_task(), control), "controller: gain Kd: nan, must be >= 0");
}

TEST(Plugin, ServesSeveralArmsInOneWorld) {
  World world;
  RobotSettings aside;
  aside.X_world_base =
      Eigen::Translation3d(0.0, 3.0, 0.0) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY());
  Arm first(world);
  Arm second(world, aside);
  Controller a(first.robot, elbow_task(), Join::dmp2);
  Controller b(second.robot, elbow_task(), Join::dmp3);
  Plugin plugin(*world);
  plugin.add(a);
  plugin.add(b);
  plugin.add(a);
  while (!b.finished()) world->stepSimulation(1e-3, 0);
  for (const Controller* controller : {&a, &b})
    EXPECT_LT((controller->last_tick().reference.position - controller->last_tick().q)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
}

TEST(Plugin, MayGoBeforeItsControllersAndAfterThem) {
  World world;
  Arm arm(world);
  auto controller = std::make_unique<Controller>(arm.robot, elbow_task(), Join::dmp3);
  {
    Plugin plugin(*world);
    plugin.add(*controller);
    world->stepSimulation(1e-3, 0);
  }
  world->stepSimulation(1e-3, 0);
  EXPECT_DOUBLE_EQ(controller->sequencer().time(), 1e-3);
  Plugin plugin(*world);
  plugin.add(*controller);
  world->stepSimulation(1e-3, 0);
  EXPECT_DOUBLE_EQ(controller->sequencer().time(), 2e-3);
  controller.reset();
  world->stepSimulation(1e-3, 0);
}

}  // namespace
}  // namespace seam
