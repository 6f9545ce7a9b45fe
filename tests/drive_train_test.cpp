// What stands between the drives and the bodies: rotors, friction, springs; against closed forms, the joints' inertia matrix, and
// a search among all ways of sticking and sliding.

#include <cmath>
#include <random>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <Eigen/Dense>
#include <gmock/gmock.h>

#include "plugin/bullet/src/stick_slip.hpp"
#include "scenes/liquid.hpp"
#include "scenes/world.hpp"
#include "tests/allocation_guard.hpp"
#include "tests/drive_step.hpp"
#include "tests/support.hpp"
#include "tests/wheel.hpp"
#include <seam/inverse_dynamics.hpp>
#include <seam/robot.hpp>

namespace seam::test {

namespace {

using testing::HasSubstr;

constexpr double dt = 1e-3;
// A wheel behind a drive.
struct Driven {
  explicit Driven(const Joint& joint, double speed = 0.0) : robot(behind(joint), *world) {
    robot.reset(one(0.0), one(speed));
  }
  static RobotModel behind(const Joint& drive) {
    RobotModel model = wheel();
    Joint& joint = model.joints[0];
    joint.damping = drive.damping;
    joint.friction = drive.friction;
    joint.rotor_inertia = drive.rotor_inertia;
    joint.stiffness = drive.stiffness;
    joint.spring_damping = drive.spring_damping;
    return model;
  }
  void step(double torque = 0.0, double tick = dt) { drive_step(world, robot, one(torque), tick); }
  /// From here on the motor alone turns.
  void kick(double speed, double tick = dt) {
    step(speed * robot.model().joints[0].rotor_inertia / tick, tick);
  }
  double at() const { return robot.multibody().getJointPos(0); }
  double speed() const { return robot.multibody().getJointVel(0); }
  double motor() const {
    Eigen::VectorXd q(1), qd(1);
    robot.measured_state(q, qd);
    return q(0);
  }

  World world;
  Robot robot;
};

TEST(DriveTrain, ViscousFrictionSlowsAWheelExponentially) {
  Joint joint;
  joint.damping = 0.6;
  Driven wheel(joint, 5.0);
  for (int k = 0; k < 500; ++k) wheel.step();
  EXPECT_NEAR(wheel.speed(), 5.0 * std::exp(-0.6 * 0.5 / inertia), 5e-3);
  EXPECT_NEAR(wheel.speed(), 5.0 * std::pow(1.0 + 0.6 * dt / inertia, -500), 1e-12);
}

TEST(DriveTrain, FrictionIsStableAtAnyTickAndAnyInertia) {
  Joint joint;
  joint.damping = 1e4;  // b·dt is 500 times the inertia
  joint.friction = 50.0;
  Driven wheel(joint, 5.0);
  wheel.step(0.0, 1e-2);
  EXPECT_NEAR(wheel.speed(), (5.0 * inertia / 1e-2 - 50.0) / (inertia / 1e-2 + 1e4), 1e-12);
  wheel.step(0.0, 1e-2);
  EXPECT_NEAR(wheel.speed(), 0.0, 1e-15);
  for (int k = 0; k < 100; ++k) wheel.step(149.0, 1e-2);
  EXPECT_NEAR(wheel.speed(), (149.0 - 50.0) / 1e4, 1e-9);
}

// It falls by c/(I + J) a second, stands after that, and then stands still.
TEST(DriveTrain, CoulombFrictionStopsAWheelAndHoldsIt) {
  Joint joint;
  joint.friction = 0.5;
  joint.rotor_inertia = 0.05;
  Driven wheel(joint, 2.0);
  for (int k = 1; k <= 900; ++k) {
    wheel.step();
    EXPECT_NEAR(wheel.speed(), 2.0 - 0.5 / (inertia + 0.05) * k * dt, 1e-9);
  }
  for (int k = 0; k < 400; ++k) wheel.step();
  const double stuck = wheel.at();
  for (int k = 0; k < 400; ++k) wheel.step(0.499);
  EXPECT_NEAR(wheel.speed(), 0.0, 1e-15);
  EXPECT_NEAR(wheel.at(), stuck, 1e-15);
  for (int k = 0; k < 100; ++k) wheel.step(0.7);
  EXPECT_NEAR(wheel.speed(), 0.2 / (inertia + 0.05) * 0.1, 1e-9);
}

RobotModel pa10_with_drives() {
  RobotModel model = RobotModel::read(std::string(SEAM_ASSETS) + "/pa10/pa10.urdf");
  const double rotors[] = {0.75, 0.75, 0.2125, 0.2125, 0.00575, 0.00575, 0.00575};
  for (std::size_t i = 0; i < 7; ++i) {
    model.joints[i].rotor_inertia = rotors[i];
    model.joints[i].damping = i < 4 ? 8.0 : 1.5;
  }
  return model;
}

Eigen::MatrixXd inertia_matrix(const InverseDynamics& dynamics, const Eigen::VectorXd& q) {
  const Eigen::Index n = q.size();
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd h(n);
  Eigen::MatrixXd M(n, n);
  dynamics.torque(q, rest, rest, h);
  for (Eigen::Index i = 0; i < n; ++i)
    dynamics.torque(q, rest, Eigen::VectorXd::Unit(n, i), M.col(i));
  return M.colwise() - h;
}

// (M + J + dt·b)(q̇⁺ − q̇)/dt = torque − h − b∘q̇, with passive joints and a tilted base; with M from the inverse dynamics.
class DriveTrains : public testing::TestWithParam<std::vector<std::size_t>> {};

TEST_P(DriveTrains, MoveTheArmAsItsEquationHasIt) {
  RobotModel model = pa10_with_drives();
  for (const std::size_t i : GetParam())
    model.joints[i].rotor_inertia = model.joints[i].damping = 0;
  add_liquid(model, "tool", Eigen::Isometry3d::Identity(), {});
  RobotSettings tilted;
  tilted.colliders = false;
  tilted.X_world_base.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  World world;
  Robot robot(model, *world, tilted);
  InverseDynamics dynamics(model);
  dynamics.set_gravity(robot.gravity_in_base());
  Eigen::VectorXd J = Eigen::VectorXd::Zero(9), b = J;
  for (int i = 0; i < 7; ++i) {
    J(i) = model.joints[static_cast<std::size_t>(i)].rotor_inertia;
    b(i) = model.joints[static_cast<std::size_t>(i)].damping;
  }
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    Eigen::VectorXd q(9), qd(9), torque(9), h(9), after(9);
    for (Eigen::Index i = 0; i < 9; ++i) {
      q(i) = (i < 7 ? 1.5 : 0.01) * uniform(random);
      qd(i) = (i < 7 ? 2.0 : 0.1) * uniform(random);
      torque(i) = i < 7 ? 50.0 * uniform(random) : 0.0;
    }
    robot.reset(q, qd);
    drive_step(world, robot, torque.head(7), dt);
    robot.state(q, after);
    dynamics.torque(q - dt * after, qd, Eigen::VectorXd::Zero(9), h);
    Eigen::MatrixXd M = inertia_matrix(dynamics, q - dt * after);
    M.diagonal() += J + dt * b;
    const Eigen::VectorXd qdd = M.ldlt().solve(torque - h - b.cwiseProduct(qd));
    EXPECT_LT(((after - qd) / dt - qdd).cwiseAbs().maxCoeff(), 1e-8 * qdd.cwiseAbs().maxCoeff());
  }
}

// In all joints; in two alone, while the drives of the others push as well.
INSTANTIATE_TEST_SUITE_P(, DriveTrains,
                         testing::Values(std::vector<std::size_t>{},
                                         std::vector<std::size_t>{1, 2, 4, 5, 6}));

// All 3ⁿ ways of sticking and sliding, of which one fits.
Eigen::VectorXd searched(const Eigen::MatrixXd& A, const Eigen::VectorXd& r,
                         const Eigen::VectorXd& c) {
  const Eigen::Index n = r.size();
  for (int way = 0; way < std::pow(3, n); ++way) {
    Eigen::VectorXd sign(n);
    int rest = way;
    for (Eigen::Index i = 0; i < n; ++i, rest /= 3) sign(i) = rest % 3 - 1;
    Eigen::MatrixXd held = A;
    Eigen::VectorXd v = r - c.cwiseProduct(sign);
    for (Eigen::Index i = 0; i < n; ++i)
      if (sign(i) == 0.0) held.row(i) = Eigen::RowVectorXd::Unit(n, i), v(i) = 0.0;
    v = held.partialPivLu().solve(v);
    const Eigen::VectorXd left = r - A * v;
    bool fits = true;
    for (Eigen::Index i = 0; i < n; ++i)
      fits &= sign(i) == 0.0 ? std::abs(left(i)) <= c(i) : v(i) * sign(i) > 0.0;
    if (fits) return v;
  }
  return Eigen::VectorXd::Constant(n, NAN);
}

TEST(StickSlip, FindsTheOneWayThatFits) {
  const int seed = 11;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    const Eigen::Index n = 1 + k % 6;
    Eigen::MatrixXd B(n, n);
    Eigen::VectorXd r(n), c(n), v(n);
    for (double& value : B.reshaped()) value = normal(random);
    for (double& value : r) value = 3.0 * normal(random);
    for (double& value : c) value = std::abs(2.0 * normal(random));
    for (double& value : v) value = normal(random);
    const Eigen::MatrixXd A = B * B.transpose() + 1e-3 * Eigen::MatrixXd::Identity(n, n);
    StickSlip stick_slip(n);
    stick_slip.solve(A, r, c, v);
    const Eigen::VectorXd exact = searched(A, r, c);
    EXPECT_LT((v - exact).norm(), 1e-9 * (1.0 + exact.norm())) << "seed " << seed << ", case " << k;
  }
}

Joint elastic(double stiffness) {
  Joint joint;
  joint.rotor_inertia = 0.1;
  joint.stiffness = stiffness;
  return joint;
}

double resonance(double stiffness) {
  return std::sqrt(stiffness / 0.1 + stiffness / inertia);  // [rad/s]
}

// Guide page 7: B·θ̈ + k(θ − q) = u, M·q̈ = k(θ − q). What the spring does, ẍ + ω²x = u/B with x = θ − q, goes on ringing
// after a step of size D in the n-th derivative of u with the amplitude D/(B·ωⁿ⁺²).
class Ringing : public testing::TestWithParam<int> {};

TEST_P(Ringing, IsTheStepInATorqueOverThePowerOfTheResonance) {
  const int n = GetParam();
  const double k = 500.0, omega = resonance(k), tick = 1e-4;
  const double size[] = {1.0, 20.0, 100.0};
  Driven wheel(elastic(k));
  double least = INFINITY, most = -INFINITY;
  for (int i = 0; i < 5000; ++i) {
    const double t = i * tick;
    const double u = size[n] * std::pow(t, n) / std::tgamma(n + 1);
    // Without what follows the torque: u/(Bω²), less u¨ of it.
    const double steady = (u - (n == 2 ? size[2] / (omega * omega) : 0.0)) / (0.1 * omega * omega);
    least = std::min(least, wheel.motor() - wheel.at() - steady);
    most = std::max(most, wheel.motor() - wheel.at() - steady);
    wheel.step(u, tick);
  }
  const double amplitude = size[n] / (0.1 * std::pow(omega, n + 2));
  EXPECT_NEAR(0.5 * (most - least), amplitude, 0.02 * amplitude);
}

INSTANTIATE_TEST_SUITE_P(, Ringing, testing::Values(0, 1, 2));

// Its frequency, and that a spring without damper loses nothing in a minute.
TEST(DriveTrain, ALosslessSpringRingsOn) {
  const double k = 500.0;
  Driven wheel(elastic(k));
  wheel.kick(1.0);
  int turns = 0;
  double before = 0.0, most = 0.0;
  for (int i = 0; i < 60000; ++i) {
    wheel.step();
    const double now = wheel.motor() - wheel.at();
    turns += before < 0.0 && now >= 0.0 ? 1 : 0;
    before = now;
    if (i > 59000) most = std::max(most, std::abs(now));
  }
  EXPECT_NEAR(turns / 60.0, resonance(k) / (2.0 * M_PI), 0.05);
  EXPECT_NEAR(most, 1.0 / resonance(k), 0.01 / resonance(k));
}

TEST(DriveTrain, ASpringIsStableHoweverStiffAndThenRigid) {
  for (const double k : {1e5, 1e7, 1e9, 1e12}) {
    Driven stiff(elastic(k)), slack(elastic(k));
    Joint joint = elastic(k);
    joint.stiffness = INFINITY;
    Driven rigid(joint);
    for (int i = 0; i < 2000; ++i) {
      const double u = std::sin(0.01 * i);
      stiff.step(u);
      rigid.step(u);
      ASSERT_NEAR(stiff.at(), rigid.at(), 1e-2) << k << " " << i;
      ASSERT_NEAR(stiff.motor(), stiff.at(), 20.0 / k) << k << " " << i;
    }
  }
}

TEST(DriveTrain, ADampedSpringDiesDown) {
  const double k = 500.0, zeta = 0.1;
  Joint joint = elastic(k);
  joint.spring_damping = 2.0 * zeta * resonance(k) / (1.0 / 0.1 + 1.0 / inertia);
  Driven wheel(joint);
  wheel.kick(1.0, 1e-4);
  double most = 0.0;
  for (int i = 0; i < 5000; ++i) {
    wheel.step(0.0, 1e-4);
    if (i >= 4200) most = std::max(most, std::abs(wheel.motor() - wheel.at()));
  }
  // One of the extremes of the last 0.08 s, which is more than a period.
  const double at_first =
      std::exp(-zeta * resonance(k) * 0.42) / (resonance(k) * std::sqrt(1.0 - zeta * zeta));
  EXPECT_LT(most, at_first);
  EXPECT_GT(most, at_first * std::exp(-zeta * resonance(k) * 0.08));
}

TEST(DriveTrain, EncodersSeeTheMotorOrTheLink) {
  RobotSettings settings;
  settings.encoders = RobotSettings::Encoders::link;
  World world;
  Robot robot(Driven::behind(elastic(10.0)), *world, settings);
  drive_step(world, robot, one(5.0), dt);
  Eigen::VectorXd q(1), qd(1);
  robot.measured_state(q, qd);
  EXPECT_EQ(qd(0), robot.multibody().getJointVel(0));
  Driven motor(elastic(10.0));
  motor.step(5.0);
  EXPECT_EQ(motor.speed(), 0.0);
  EXPECT_NEAR(motor.motor(), dt * dt * 5.0 / 0.1, 1e-12);
}

// The springs of an arm that was put somewhere bear it.
TEST(DriveTrain, AnElasticArmIsPutWhereItRests) {
  RobotModel model = pa10_with_drives();
  for (Joint& joint : model.joints) joint.stiffness = 5e3;
  World world;
  Robot robot(model, *world);
  Eigen::VectorXd q(7), rest = Eigen::VectorXd::Zero(7), holding(7), now(7), speed(7);
  q << 0.2, 0.5, -0.3, 0.8, 0.4, 0.6, -0.1;
  robot.reset(q, rest);
  InverseDynamics(model).torque(q, rest, rest, holding);
  for (int k = 0; k < 200; ++k) {
    drive_step(world, robot, holding, dt);
  }
  robot.state(now, speed);
  EXPECT_LT((now - q).norm(), 1e-10);
}

// Bullet keeps joint torques over its substeps.
TEST(DriveTrain, IsRightForAnyNumberOfSubsteps) {
  Joint joint;
  joint.damping = 0.6;
  joint.friction = 0.1;
  joint.rotor_inertia = 0.05;
  Driven one_by_one(joint), at_once(joint);
  at_once.world->setInternalTickCallback(
      [](btDynamicsWorld* world, btScalar tick) {
        static_cast<Robot*>(world->getWorldUserInfo())->drive(tick, one(1.0));
      },
      &at_once.robot, true);
  for (int k = 0; k < 40; ++k) {
    one_by_one.robot.multibody().addJointTorque(0, 0.3);
    one_by_one.step(1.0);
  }
  for (int k = 0; k < 10; ++k) {
    at_once.robot.multibody().addJointTorque(0, 0.3);
    at_once.world->stepSimulation(4 * dt, 4, dt);
  }
  EXPECT_NEAR(at_once.speed(), one_by_one.speed(), 1e-14);
  EXPECT_NEAR(at_once.at(), one_by_one.at(), 1e-14);
}

TEST(DriveTrain, IsNotThereIfTheAppHasItsOwn) {
  Joint joint;
  joint.damping = 5.0;
  RobotSettings settings;
  settings.joint_dynamics = false;
  World world;
  Robot robot(Driven::behind(joint), *world, settings);
  robot.reset(one(0.0), one(1.0));
  drive_step(world, robot, one(0.0), dt);
  EXPECT_EQ(robot.multibody().getJointVel(0), 1.0);
}

TEST(DriveTrain, AllocatesNothing) {
  RobotModel model = pa10_with_drives();
  for (std::size_t i = 0; i < 3; ++i) {
    model.joints[i].stiffness = 1e4;
    model.joints[i].friction = 3.0;
  }
  World world;
  Robot robot(model, *world);
  const Eigen::VectorXd torque = Eigen::VectorXd::Constant(7, 20.0);
  robot.drive(dt, torque);  // Bullet's profiler notes its first call
  const AllocationGuard guard;
  robot.drive(dt, torque);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(DriveTrain, RefusesWhatCannotBe) {
  const auto refused = [](double Joint::*value, double is) {
    Joint joint = elastic(10.0);
    joint.*value = is;
    return refusal([&] { Driven{joint}; });
  };
  EXPECT_EQ(refused(&Joint::damping, -1.0), "joint \"turn\": damping -1, must be finite and >= 0");
  EXPECT_EQ(refused(&Joint::friction, NAN),
            "joint \"turn\": friction nan, must be finite and >= 0");
  EXPECT_EQ(refused(&Joint::stiffness, 0.0), "joint \"turn\": stiffness 0, must be > 0");
  EXPECT_EQ(refused(&Joint::rotor_inertia, 0.0),
            "joint \"turn\": rotor inertia 0, must be > 0, since the joint is elastic");
}

}  // namespace

}  // namespace seam::test
