#include <cmath>
#include <cstdio>
#include <thread>

#include <gtest/gtest.h>

#include "tests/allocation_guard.hpp"
#include "tests/kdl_robot.hpp"
#include "tests/random_robot.hpp"
#include "tests/temp_folder.hpp"
#include <seam/error.hpp>
#include <seam/inverse_dynamics.hpp>

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

const std::string pa10 = SEAM_ASSETS "/pa10/pa10.urdf";
const std::string skew_tree = SEAM_TEST_DATA "/skew_tree.urdf";
const std::string pendulum = SEAM_TEST_DATA "/pendulum.urdf";
const std::string planar_arm = SEAM_TEST_DATA "/planar_arm.urdf";

VectorXd torque(const seam::InverseDynamics& dynamics, const VectorXd& q, const VectorXd& qd,
                const VectorXd& qdd) {
  VectorXd result(dynamics.dof());
  dynamics.torque(q, qd, qdd, result);
  return result;
}

double torque(const seam::InverseDynamics& dynamics, double q, double qd, double qdd) {
  return torque(dynamics, VectorXd::Constant(1, q), VectorXd::Constant(1, qd),
                VectorXd::Constant(1, qdd))[0];
}

std::vector<std::string> joint_names(const seam::RobotModel& model) {
  std::vector<std::string> names;
  for (const auto& joint : model.joints) names.push_back(joint.name);
  return names;
}

/// Largest difference to KDL over random states, relative to the largest torque of the state.
double worst_difference_to_kdl(const std::string& urdf, RandomRobot& random, int states) {
  const auto model = seam::RobotModel::read(urdf);
  const auto names = joint_names(model);
  const KdlRobot kdl(urdf);
  seam::InverseDynamics dynamics(model);
  double worst = 0.0;
  for (int i = 0; i < states; ++i) {
    const VectorXd q = random.vector(model.dof(), 3.0);
    const VectorXd qd = random.vector(model.dof(), 4.0);
    const VectorXd qdd = random.vector(model.dof(), 30.0);
    const Vector3d gravity = random.vector(3, 10.0);
    dynamics.set_gravity(gravity);
    const VectorXd theirs = kdl.torque(names, q, qd, qdd, gravity);
    const VectorXd difference = torque(dynamics, q, qd, qdd) - theirs;
    worst = std::max(worst, difference.cwiseAbs().maxCoeff() / theirs.cwiseAbs().maxCoeff());
  }
  return worst;
}

class InverseDynamicsOf : public testing::TestWithParam<std::string> {};

TEST_P(InverseDynamicsOf, AgreesWithOrocosKdlInAnyGravity) {
  const unsigned seed = 11;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomRobot random(seed);
  const double worst = worst_difference_to_kdl(GetParam(), random, 1000);
  std::printf("worst relative difference %.2g\n", worst);
  EXPECT_LE(worst, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Files, InverseDynamicsOf,
                         testing::Values(pa10, skew_tree, pendulum, planar_arm));

TEST(InverseDynamics, AgreesWithOrocosKdlOnRandomTrees) {
  const TempFolder folder;
  for (unsigned seed = 100; seed < 140; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomRobot random(seed);
    const std::string file = folder.write("random.urdf", random.urdf(random.integer(2, 14)));
    EXPECT_LE(worst_difference_to_kdl(file, random, 25), 1e-10);
  }
}

// m = 2 kg, l = 0.5 m, I = 0.03 kg m²: torque = (I + m l²) q̈ + m g l sin q.
TEST(InverseDynamics, HoldsAPendulumByTheClosedForm) {
  const seam::InverseDynamics dynamics(seam::RobotModel::read(pendulum));
  for (const double q : {-2.0, -0.3, 0.0, 0.7, 1.5707963, 3.0}) {
    const double expected = (0.03 + 2.0 * 0.25) * 4.0 + 2.0 * 9.81 * 0.5 * std::sin(q);
    EXPECT_NEAR(torque(dynamics, q, 7.0, 4.0), expected, 1e-13);
  }
}

// Mass matrix, Coriolis and gravity terms of the two-link arm as textbooks give them.
TEST(InverseDynamics, BearsNoWeightWhereTheFirstGravityIsNone) {
  seam::InverseDynamics dynamics(seam::RobotModel::read(pendulum));
  dynamics.set_gravity(Vector3d::Zero());
  EXPECT_EQ(torque(dynamics, 0.7, 0.0, 0.0), 0.0);
}

TEST(InverseDynamics, MovesAPlanarArmByTheClosedForm) {
  seam::InverseDynamics dynamics(seam::RobotModel::read(planar_arm));
  const double m1 = 3.0, m2 = 1.5, l1 = 0.4, r1 = 0.25, r2 = 0.12, I1 = 0.055, I2 = 0.02, g = 9.81;
  dynamics.set_gravity({0.0, -g, 0.0});
  RandomRobot random(5);
  for (int i = 0; i < 100; ++i) {
    const VectorXd q = random.vector(2, 3.0), qd = random.vector(2, 5.0),
                   qdd = random.vector(2, 20.0);
    const double c2 = std::cos(q[1]), h = m2 * l1 * r2 * std::sin(q[1]);
    const double a = I2 + m2 * (r2 * r2 + l1 * r2 * c2);
    Eigen::Matrix2d M;
    M << I1 + I2 + m1 * r1 * r1 + m2 * (l1 * l1 + r2 * r2 + 2.0 * l1 * r2 * c2), a, a,
        I2 + m2 * r2 * r2;
    const Eigen::Vector2d coriolis(-h * (2.0 * qd[0] * qd[1] + qd[1] * qd[1]), h * qd[0] * qd[0]);
    const double lower = m2 * r2 * g * std::cos(q[0] + q[1]);
    const Eigen::Vector2d weight((m1 * r1 + m2 * l1) * g * std::cos(q[0]) + lower, lower);
    const VectorXd expected = M * qdd + coriolis + weight;
    EXPECT_LE((torque(dynamics, q, qd, qdd) - expected).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(InverseDynamics, FeelsAPayloadThatIsAddedToTheModel) {
  auto model = seam::RobotModel::read(pendulum);
  const double bare = torque(seam::InverseDynamics(model), 0.4, 0.0, 2.0);
  const seam::Inertial payload{0.5, Vector3d(0.0, 0.0, -0.8), 1e-3 * Eigen::Matrix3d::Identity()};
  model.bodies[0].inertial = model.bodies[0].inertial + payload;
  const double added = (1e-3 + 0.5 * 0.64) * 2.0 + 0.5 * 9.81 * 0.8 * std::sin(0.4);
  EXPECT_NEAR(torque(seam::InverseDynamics(model), 0.4, 0.0, 2.0), bare + added, 1e-13);
}

// What it works in is shared by all of a model.
TEST(InverseDynamics, OfOneModelDoNotDisturbEachOther) {
  const auto model = seam::RobotModel::read(pa10);
  seam::InverseDynamics hanging(model), standing(model);
  hanging.set_gravity({0.0, 0.0, 9.81});
  RandomRobot random(5);
  const VectorXd q = random.vector(7, 2.0), qd = random.vector(7, 1.0), qdd = random.vector(7, 5.0);
  const VectorXd alone = torque(standing, q, qd, qdd);
  const VectorXd other = torque(hanging, -q, qd, qdd);
  EXPECT_GT((other - alone).norm(), 1.0);
  EXPECT_EQ(torque(standing, q, qd, qdd), alone);
  EXPECT_EQ(torque(hanging, -q, qd, qdd), other);
  hanging.set_gravity({0.0, 0.0, -9.81});
  EXPECT_EQ(torque(hanging, q, qd, qdd), alone);
}

TEST(InverseDynamics, OfAnotherMassIsItsOwn) {
  auto model = seam::RobotModel::read(pa10);
  const seam::InverseDynamics light(model);
  model.bodies.back().inertial.mass += 1.0;
  const seam::InverseDynamics heavy(model);
  const VectorXd q = VectorXd::Constant(7, 0.5), rest = VectorXd::Zero(7);
  EXPECT_GT((torque(heavy, q, rest, rest) - torque(light, q, rest, rest)).norm(), 1.0);
}

TEST(InverseDynamics, WorksInManyThreadsAtOnce) {
  const auto model = seam::RobotModel::read(pa10);
  RandomRobot random(6);
  std::vector<VectorXd> states;
  std::vector<VectorXd> expected;
  std::vector<seam::InverseDynamics> dynamics;
  for (int i = 0; i < 4; ++i) {
    states.push_back(random.vector(7, 2.0));
    dynamics.emplace_back(model);
    expected.push_back(torque(dynamics.back(), states.back(), states.back(), states.back()));
  }
  const seam::InverseDynamics here(model);
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      for (int k = 0; k < 2000; ++k)
        if (torque(dynamics[i], states[i], states[i], states[i]) != expected[i]) ++wrong[i];
    });
  for (int k = 0; k < 2000; ++k)  // in the tree that all share
    EXPECT_EQ(torque(here, states[1], states[1], states[1]), expected[1]);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(InverseDynamics, AllocatesNothingInACall) {
  seam::InverseDynamics dynamics(seam::RobotModel::read(pa10));
  const VectorXd q = VectorXd::Constant(7, 0.3);
  VectorXd result(7);
  const AllocationGuard guard;
  dynamics.set_gravity({0.0, 0.0, -9.81});
  for (int i = 0; i < 10; ++i) dynamics.torque(q, q, q, result);
  EXPECT_EQ(guard.allocations(), 0);
}

// A plate's third moment is the sum of the others, which rounding breaks by an ulp.
TEST(InverseDynamics, TakesFlatBodiesWithoutAWord) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (unsigned seed = 1; seed <= 50; ++seed) {
    auto model = seam::RobotModel::read(pendulum);
    const Eigen::Matrix3d R = RandomRobot(seed).pose().linear();
    model.bodies[0].inertial.com.setZero();
    model.bodies[0].inertial.inertia =
        R * Vector3d(0.1, 0.2, 0.1 + 0.2).asDiagonal() * R.transpose();
    const double I_yy = model.bodies[0].inertial.inertia(1, 1);
    EXPECT_NEAR(torque(seam::InverseDynamics(model), 0.0, 0.0, 3.0), 3.0 * I_yy, 1e-14)
        << "seed " << seed;
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(InverseDynamics, OfARobotWithoutJointsIsEmpty) {
  const TempFolder folder;
  const auto model = seam::RobotModel::read(
      folder.write("t.urdf", R"(<robot name="table"><link name="top"/></robot>)"));
  const seam::InverseDynamics dynamics(model);
  EXPECT_EQ(dynamics.dof(), 0);
  EXPECT_EQ(torque(dynamics, VectorXd(0), VectorXd(0), VectorXd(0)).size(), 0);
}

TEST(InverseDynamics, RefusesAModelWhoseParentsComeLater) {
  auto model = seam::RobotModel::read(planar_arm);
  model.joints[0].parent = 1;
  EXPECT_THROW(seam::InverseDynamics{model}, seam::Error);
}

}  // namespace
