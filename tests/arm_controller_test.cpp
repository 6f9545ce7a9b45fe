#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>

#include "plugin/examples/movement.hpp"
#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/arm.hpp>
#include <seam/seam.hpp>

namespace seam::test {

namespace {

using testing::HasSubstr;
using Status = ArmController::Status;

constexpr double dt = 1e-3;

const RobotModel& pa10() {
  static const RobotModel model = RobotModel::read(std::string(SEAM_ASSETS) + "/pa10/pa10.urdf");
  return model;
}

Eigen::VectorXd bent() {
  Eigen::VectorXd q(7);
  q << 0.2, 0.5, -0.3, 0.8, 0.4, 0.6, -0.1;
  return q;
}

Sequence elbow() {
  Sequence task;
  task.then(learn(
      movement({"E1"}, Eigen::VectorXd::Constant(1, 0.8), Eigen::VectorXd::Constant(1, 1.2), 1.0)));
  return task;
}

/// The arm, integrated semi-implicitly; forward dynamics by the joints' inertia matrix.
struct Arm {
  explicit Arm(const Eigen::Vector3d& gravity = {0.0, 0.0, -9.81}) : dynamics(pa10()) {
    dynamics.set_gravity(gravity);
  }
  void step(const Eigen::VectorXd& torque) {
    Eigen::VectorXd h(7);
    Eigen::MatrixXd M(7, 7);
    dynamics.torque(q, qd, Eigen::VectorXd::Zero(7), h);
    for (int i = 0; i < 7; ++i) dynamics.torque(q, qd, Eigen::VectorXd::Unit(7, i), M.col(i));
    M.colwise() -= h;
    qd += dt * M.ldlt().solve(torque - h);
    q += dt * qd;
  }

  InverseDynamics dynamics;
  Eigen::VectorXd q = bent(), qd = Eigen::VectorXd::Zero(7);
};

ArmController controller_of(const Arm& arm, const ArmControllerSettings& settings = {},
                            const Sequence& task = elbow()) {
  return {pa10(), task, Join::dmp3, settings, arm.q, arm.qd};
}

double play(Arm& arm, ArmController& controller, double seconds) {
  double error = 0.0;
  for (int k = 0; k < std::lround(seconds / dt); ++k) {
    const Eigen::VectorXd& torque = controller.tick(dt, arm.q, arm.qd);
    error =
        std::max(error, (controller.last_tick().reference.position - arm.q).cwiseAbs().maxCoeff());
    arm.step(torque);
  }
  return error;
}

TEST(ArmController, FollowsToRoundOff) {
  Arm arm;
  ArmController controller = controller_of(arm);
  EXPECT_LT(play(arm, controller, 4.0), 1e-12);
  EXPECT_TRUE(controller.finished());
  EXPECT_NEAR(arm.q(3), 1.2, 1e-4);
  EXPECT_EQ(controller.status(), Status::following);
}

TEST(ArmController, HoldsAgainstTheGravityThatItIsGiven) {
  const Eigen::Vector3d sideways(0.0, 9.81, 0.0);
  Arm arm(sideways);
  ArmController controller = controller_of(arm);
  controller.set_gravity(sideways);
  EXPECT_LT(play(arm, controller, 0.5), 1e-12);
  ArmController mistaken = controller_of(arm);
  EXPECT_GT(play(arm, mistaken, 0.1), 1e-4);
}

TEST(ArmController, DoesNothingWhereNoTimePasses) {
  Arm arm;
  ArmController controller = controller_of(arm);
  const Eigen::VectorXd torque = controller.tick(dt, arm.q, arm.qd);
  const double time = controller.sequencer().time();
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(controller.tick(none, arm.q, arm.qd), torque);
  EXPECT_EQ(controller.sequencer().time(), time);
}

TEST(ArmController, GivesWhatTheActuatorDelivers) {
  Arm arm;
  ArmControllerSettings settings;
  settings.actuator.quantum = 0.5;
  ArmController controller = controller_of(arm, settings);
  const Eigen::VectorXd torque = controller.tick(dt, arm.q, arm.qd);
  EXPECT_NE(torque, controller.last_tick().torque);
  EXPECT_EQ(torque, 0.5 * (torque / 0.5).array().round().matrix());
  EXPECT_EQ(controller.tick(0.0, arm.q, arm.qd), torque);
}

TEST(ArmController, BridgesAndStopsWithoutAState) {
  Arm arm;
  ArmController controller = controller_of(arm);
  play(arm, controller, 0.2);
  const Eigen::VectorXd nowhere =
      Eigen::VectorXd::Constant(7, std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 50; ++k) arm.step(controller.tick(dt, nowhere, nowhere));
  EXPECT_EQ(controller.status(), Status::bridging);
  play(arm, controller, 0.1);
  EXPECT_EQ(controller.status(), Status::following);
  for (int k = 0; k < 150; ++k) arm.step(controller.tick(dt, nowhere, nowhere));
  EXPECT_EQ(controller.status(), Status::stopped);
  EXPECT_THAT(controller.what_happened(), HasSubstr("there was no state of the joints"));
}

TEST(ArmController, TakesTheSequenceUpAgainFromElsewhere) {
  Arm arm;
  ArmController controller = controller_of(arm);
  play(arm, controller, 0.3);
  arm.q(0) += 0.5;
  play(arm, controller, 0.01);
  EXPECT_EQ(controller.status(), Status::stopped);
  EXPECT_EQ(controller.incident().joint, 0);
  EXPECT_TRUE(controller.reinitialise(arm.q, arm.qd));
  EXPECT_EQ(controller.status(), Status::following);
  EXPECT_LT(play(arm, controller, 2.0), 1e-9);
  EXPECT_NEAR(arm.q(3), 1.2, 1e-3);
}

TEST(ArmController, MayBeMovedInMemory) {
  Arm arm;
  ArmController first = controller_of(arm);
  play(arm, first, 0.3);
  ArmController second = std::move(first);
  EXPECT_LT(play(arm, second, 0.5), 1e-12);
}

TEST(ArmController, AllocatesNothingInATick) {
  ToolSettings tool;
  tool.link = "tool";
  Arm arm;
  Kinematics hand(pa10(), "tool");
  hand.move_to(arm.q);
  const Eigen::Vector3d here = hand.X_base_tool().translation();
  Sequence task;
  task.then(learn(movement({"x", "y", "z"}, here, here + Eigen::Vector3d(0.0, 0.1, 0.0), 1.0)));
  ArmController in_joints = controller_of(arm);
  ArmController in_space = controller_of(arm, {{}, tool}, task);
  const AllocationGuard guard;
  for (int k = 0; k < 10; ++k) {
    in_joints.tick(dt, arm.q, arm.qd);
    in_space.tick(dt, arm.q, arm.qd);
  }
  in_joints.reinitialise(arm.q, arm.qd);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(ArmController, RefusesWhatIsNoState) {
  Arm arm;
  const auto made_with = [](const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
    return refusal([&] { ArmController(pa10(), elbow(), Join::dmp3, {}, q, qd); });
  };
  EXPECT_EQ(made_with(arm.q.head(6), arm.qd),
            "controller: q: 6 numbers, must be 7, one for each joint");
  EXPECT_EQ(made_with(arm.q, arm.qd.head(1)),
            "controller: qd: 1 numbers, must be 7, one for each joint");
  arm.q(2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(made_with(arm.q, arm.qd), "controller: the joints' state is not finite");
}

}  // namespace

}  // namespace seam::test
