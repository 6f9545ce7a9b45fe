// What can go wrong around an arm, and that it stays bounded, says what happened, and goes on when told to. The bounds
// below are the ones that the guide states.

#include <functional>
#include <vector>

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/elbow.hpp"

namespace seam {
namespace {

using Cause = Incident::Cause;
using Status = Controller::Status;
using test::App;
using test::elbow_task;
using test::ramp;
using test::tracking_error;
using testing::HasSubstr;

constexpr int elbow = 3;

/// The elbow there and back at 1 rad/s.
Sequence swing() {
  return Sequence().then(learn(ramp("E1", 0.8, 1.3))).then(learn(ramp("E1", 1.3, 0.8)));
}

/// What is seen of an arm over a while.
struct Seen {
  double deviation = 0.0;     // [rad] of a joint from its reference
  double speed = 0.0;         // [rad/s] of a joint
  double torque_step = 0.0;   // [N·m] over a tick
  double kink = 0.0;          // [rad/s²] step of a joint's reference acceleration over a tick
  double elbow_most = -10.0;  // [rad]
};

Seen watch(App& app, double seconds) {
  Seen seen;
  Eigen::VectorXd before = app.controller.last_tick().reference.acceleration;
  Eigen::VectorXd torque = app.controller.last_tick().torque;
  for (int k = 0; k < std::lround(seconds * 1000.0); ++k) {
    const Controller::Tick& tick = app.step();
    EXPECT_TRUE(tick.torque.allFinite());
    seen.deviation = std::max(seen.deviation, tracking_error(app.controller));
    seen.speed = std::max(seen.speed, tick.qd.cwiseAbs().maxCoeff());
    seen.elbow_most = std::max(seen.elbow_most, tick.q(elbow));
    const Eigen::VectorXd& now = tick.reference.acceleration;
    seen.kink = std::max(seen.kink, (now - before).cwiseAbs().maxCoeff());
    seen.torque_step = std::max(seen.torque_step, (tick.torque - torque).cwiseAbs().maxCoeff());
    before = now;
    torque = tick.torque;
  }
  return seen;
}

/// It goes on when told to, and arrives.
void expect_recovery(App& app, double goal = 0.8) {
  EXPECT_TRUE(app.controller.reinitialise());
  EXPECT_EQ(app.controller.status(), Status::following);
  EXPECT_EQ(app.controller.incident().cause, Cause::none);
  app.play(3.0);
  EXPECT_EQ(app.controller.status(), Status::following) << app.controller.what_happened();
  EXPECT_LT(tracking_error(app.controller), 1e-6);
  EXPECT_NEAR(app.q()(elbow), goal, 2e-3);
}

ControllerSettings with_dropout(double from, double to, Dropout::What what) {
  ControllerSettings settings;
  settings.sensor.dropouts = {{from, to, what}};
  return settings;
}

/// A controller that takes all masses for 10 % larger than they are.
ControllerSettings heavier(ControllerSettings settings) {
  settings.model = RobotModel::read(test::pa10);
  for (Body& body : settings.model->bodies) {
    body.inertial.mass *= 1.1;
    body.inertial.inertia *= 1.1;
  }
  return settings;
}

// Whatever happens, a tick neither allocates nor gives a torque that is not finite.
TEST(BadDay, AllocatesNothing) {
  const std::vector<std::function<void(App&, int)>> days{
      [](App& app, int k) {
        if (k == 250) app.controller.sequencer().set_goal(Eigen::VectorXd::Constant(1, 3.0));
      },
      [](App& app, int k) {
        if (k > 250) app.arm.robot.multibody().addJointTorque(elbow, -400.0);
      },
      [](App&, int) {}};
  for (const Dropout::What what : {Dropout::What::missing, Dropout::What::frozen})
    for (const double until : {0.24, 0.7})
      for (const auto& day : days) {
        App app(swing(), with_dropout(0.2, until, what));
        app.plugin.remove(app.controller);
        long allocations = 0;
        for (int k = 0; k < 1000; ++k) {
          day(app, k);
          const AllocationGuard guard;
          app.controller.pre_tick(1e-3);
          allocations += guard.allocations();
          EXPECT_TRUE(app.controller.last_tick().torque.allFinite());
          app.world->stepSimulation(1e-3, 0);
        }
        EXPECT_EQ(allocations, 0);
      }
}

// Sensor dropouts

TEST(Dropout, OfTheStateIsBridgedByTheTorqueOfTheReference) {
  App app(swing(), with_dropout(0.3, 0.38, Dropout::What::missing));
  app.play(0.35);
  EXPECT_EQ(app.controller.status(), Status::bridging);
  EXPECT_EQ(app.controller.incident().cause, Cause::no_state);
  EXPECT_NEAR(app.controller.incident().time, 0.3, 1.5e-3);
  EXPECT_LT(watch(app, 1.5).deviation, 1e-9);
  EXPECT_EQ(app.controller.status(), Status::following);
  EXPECT_THAT(app.controller.what_happened(),
              HasSubstr("no state of the joints for 0.08 s, which was bridged"));
}

TEST(Dropout, OfAFrozenStateIsSeenAndBridged) {
  App app(swing(), with_dropout(0.3, 0.38, Dropout::What::frozen));
  const Seen seen = watch(app, 0.37);
  EXPECT_EQ(app.controller.status(), Status::bridging);
  EXPECT_LT(seen.deviation, 0.01) << "until it is seen";
  EXPECT_LT(watch(app, 0.05).torque_step, 0.2) << "as the state comes back";
  EXPECT_LT(watch(app, 2.0).deviation, 0.02);
  EXPECT_EQ(app.controller.status(), Status::following);
  EXPECT_LT(tracking_error(app.controller), 1e-6);
}

TEST(Dropout, IsBridgedByAModelThatErrs) {
  for (const Dropout::What what : {Dropout::What::missing, Dropout::What::frozen}) {
    App app(swing(), heavier(with_dropout(0.3, 0.38, what)));
    EXPECT_LT(watch(app, 2.5).deviation, 0.06);
    EXPECT_EQ(app.controller.status(), Status::following);
  }
}

TEST(Dropout, ThatLastsStopsTheArmSmoothlyUntilItIsToldToGoOn) {
  for (const Dropout::What what : {Dropout::What::missing, Dropout::What::frozen}) {
    App app(swing(), with_dropout(0.3, 1.0, what));
    app.play(0.29);
    const Seen stopping = watch(app, 0.7);
    EXPECT_EQ(app.controller.status(), Status::stopped);
    EXPECT_EQ(app.controller.incident().cause, Cause::no_state);
    EXPECT_GT(app.controller.incident().value, 0.1);
    EXPECT_LT(stopping.deviation, 0.03);
    EXPECT_LT(stopping.speed, 1.6) << "it swings at 1 rad/s";
    EXPECT_LT(stopping.kink, 1.0) << "[rad/s²] in 1 ms";
    const Seen standing = watch(app, 1.0);
    EXPECT_LT(standing.deviation, 0.03);
    EXPECT_LT(standing.torque_step, 0.5) << "as the state comes back";
    EXPECT_LT(app.controller.last_tick().qd.cwiseAbs().maxCoeff(), 1e-3);
    expect_recovery(app);
  }
}

TEST(Dropout, OfBulletsOwnStateIsSurvived) {
  App app(swing());
  app.play(0.3);
  const Eigen::VectorXd q = app.q();
  app.arm.robot.multibody().setJointVel(2, NAN);
  EXPECT_FALSE(app.controller.reinitialise());
  for (int k = 0; k < 200; ++k) {
    app.controller.pre_tick(1e-3);
    EXPECT_TRUE(app.controller.last_tick().torque.allFinite());
  }
  EXPECT_EQ(app.controller.status(), Status::stopped);
  EXPECT_EQ(app.controller.incident().cause, Cause::no_state);
  app.arm.robot.multibody().clearForcesAndTorques();
  app.arm.robot.reset(q, Eigen::VectorXd::Zero(7));
  expect_recovery(app);
}

// Drives that are too weak

// Drives of 8 N·m, of which the shoulder needs 57 to hold the arm up.
TEST(Saturation, ForLongLetsTheArmSinkAndNoMore) {
  ControllerSettings weak;
  weak.model = RobotModel::read(test::pa10);
  for (Joint& joint : weak.model->joints) joint.effort = 8.0;
  weak.actuator.limit_effort = true;
  App app(swing(), weak);
  const Seen seen = watch(app, 10.0);
  EXPECT_EQ(app.controller.status(), Status::stopped);
  EXPECT_EQ(app.controller.incident().cause, Cause::deviation);
  EXPECT_LE(seen.deviation, 0.3 + 0.02) << "one tick at the speed that it has";
  EXPECT_LT(seen.speed, 20.0);
  EXPECT_GT(seen.speed, 1.0) << "it does sink";
  EXPECT_LT(watch(app, 1.0).speed, 1e-3) << "and comes to rest";
}

// For a second something pulls at the elbow that is stronger than its drive (68 N·m).
TEST(Saturation, ByAPullThatEndsIsRecoveredFrom) {
  ControllerSettings limited;
  limited.actuator.limit_effort = true;
  App app(swing(), limited);
  app.play(0.2);
  double speed = 0.0;
  for (int k = 0; k < 1000; ++k) {
    app.arm.robot.multibody().addJointTorque(elbow, -100.0);
    speed = std::max(speed, app.step().qd.cwiseAbs().maxCoeff());
  }
  EXPECT_EQ(app.controller.status(), Status::stopped);
  EXPECT_THAT(app.controller.what_happened(), HasSubstr("was off its reference by 0.3"));
  EXPECT_LT(speed, 25.0);
  EXPECT_LT(watch(app, 2.0).deviation, 0.32);
  EXPECT_LT(app.controller.last_tick().qd.cwiseAbs().maxCoeff(), 1e-2) << "it rests";
  app.controller.sequencer().set_tau(2.0);
  expect_recovery(app);
}

// A hit

TEST(Hit, AgainstAnObstacleStopsTheArmThere) {
  App app(Sequence().then(learn(ramp("E1", 0.8, 1.7))));
  Kinematics tool(app.arm.robot.model(), "tool");
  Eigen::VectorXd q = test::bent();
  q(elbow) = 1.2;
  tool.move_to(q);
  const Eigen::Vector3d at = tool.X_base_tool().translation();
  btBoxShape shape(btVector3(0.06, 0.06, 0.06));
  btRigidBody box(btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, &shape));
  box.setWorldTransform(
      btTransform(btQuaternion::getIdentity(), btVector3(at.x(), at.y(), at.z())));
  app.world->addRigidBody(&box);
  const Seen seen = watch(app, 3.0);
  EXPECT_EQ(app.controller.status(), Status::stopped);
  EXPECT_EQ(app.controller.incident().cause, Cause::deviation);
  // The wrist, whose soft feedback asks for little until then.
  EXPECT_LE(seen.deviation, app.controller.incident().bound + 0.02);
  EXPECT_LT(app.controller.incident().bound, 0.7);
  EXPECT_LT(seen.elbow_most, 1.5) << "it does not go through";
  EXPECT_LT(seen.speed, 12.0);
  EXPECT_LT(app.controller.last_tick().qd.cwiseAbs().maxCoeff(), 0.05);
  app.world->removeRigidBody(&box);
  expect_recovery(app, 1.7);
}

// Ticks

TEST(Tick, ThatBecomesTenTimesLongerOrShorterMovesTheArmByLessThanAMilliradian) {
  for (const auto& [before, after] : {std::pair{1e-3, 1e-2}, {1e-2, 1e-3}, {4e-3, 4e-2}}) {
    App app(swing());
    for (int k = 0; k < std::lround(0.2 / before); ++k) app.step(before);
    double farthest = 0.0;
    for (int k = 0; k < std::lround(2.0 / after); ++k) {
      app.step(after);
      farthest = std::max(farthest, tracking_error(app.controller));
    }
    EXPECT_LT(farthest, 0.1 * std::max(before, after)) << before << " to " << after;
    EXPECT_LT(tracking_error(app.controller), 1e-6);
    EXPECT_EQ(app.controller.status(), Status::following);
  }
}

// Goals and limits

TEST(Goal, BeyondALimitStopsTheArmAtOnce) {
  for (const Join method : all_joins) {
    App app(Sequence().then(learn(ramp("E1", 0.8, 1.3))), {}, method);
    app.play(0.3);
    ASSERT_TRUE(app.controller.sequencer().set_goal(Eigen::VectorXd::Constant(1, 3.0)));
    const double before = app.q()(elbow);
    const Seen seen = watch(app, 1.5);
    EXPECT_EQ(app.controller.status(), Status::stopped);
    EXPECT_EQ(app.controller.incident().cause, Cause::goal);
    EXPECT_THAT(app.controller.what_happened(), HasSubstr("\"E1\" was given the goal 3 rad"));
    EXPECT_LT(seen.elbow_most, before + 0.2);
    EXPECT_LT(seen.deviation, 1e-9);
    EXPECT_LT(app.controller.last_tick().qd.cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_FALSE(app.controller.reinitialise()) << "the goal is still the same";
    EXPECT_EQ(app.controller.status(), Status::stopped);
    ASSERT_TRUE(app.controller.sequencer().set_goal(Eigen::VectorXd::Constant(1, 0.9)));
    expect_recovery(app, 0.9);
  }
}

// The goal is within the limits (3.09 rad), the way to it is not.
TEST(JointLimit, OnTheWayStopsTheArmThere) {
  Demonstration over = test::demonstrate(3.0, [](double t) {
    const double w = 2.0 * M_PI / 3.0;
    return Eigen::Vector3d(0.2 + 1.6 * (1.0 - std::cos(w * t)), 1.6 * w * std::sin(w * t),
                           1.6 * w * w * std::cos(w * t));
  });
  over.coordinates = {"S1"};
  App app(Sequence().then(learn(over)));
  const Joint& joint = app.arm.robot.model().joints[0];
  double most = 0.0;
  while (!app.controller.finished()) {
    most = std::max(most, app.step().q(0));
    ASSERT_LT(tracking_error(app.controller), 1e-9);
  }
  EXPECT_EQ(app.controller.incident().cause, Cause::joint_limit);
  const double slack = 0.01 * (joint.upper - joint.lower);
  const double speed = 1.6 * 2.0 * M_PI / 3.0;
  EXPECT_NEAR(app.controller.incident().value, joint.upper + slack, 1e-3 * speed);
  EXPECT_GT(most, joint.upper + slack);
  EXPECT_LT(most, joint.upper + slack + 0.11 * speed) << "[s] to stop";
  EXPECT_LT(app.q()(0), joint.upper + slack + 1e-3 * speed) << "where it rests";
}

}  // namespace
}  // namespace seam
