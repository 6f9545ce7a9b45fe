#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/kdl_robot.hpp"
#include "tests/random_robot.hpp"
#include "tests/support.hpp"
#include "tests/temp_folder.hpp"
#include <seam/kinematics.hpp>

namespace seam {
namespace {

const std::string pa10 = std::string(SEAM_ASSETS) + "/pa10/pa10.urdf";

std::vector<std::string> names(const RobotModel& model) {
  std::vector<std::string> list;
  for (const Joint& joint : model.joints) list.push_back(joint.name);
  return list;
}

TEST(Kinematics, PoseIsThatOfAnotherLibrary) {
  RandomRobot random(61);
  const TempFolder folder;
  for (int i = 0; i < 30; ++i) {
    const std::string path = i == 0 ? pa10 : folder.write("robot.urdf", random.urdf(9));
    const RobotModel model = RobotModel::read(path);
    const std::string link = i == 0 ? "tool" : "l8";
    if (model.frame(link).body < 0) continue;
    Kinematics kinematics(model, link);
    const KdlRobot kdl(path);
    for (int k = 0; k < 20; ++k) {
      const Eigen::VectorXd q = random.vector(model.dof(), 2.0);
      kinematics.move_to(q);
      EXPECT_LT((kinematics.X_base_tool().matrix() - kdl.pose(names(model), q, link).matrix())
                    .cwiseAbs()
                    .maxCoeff(),
                1e-13)
          << "seed 61, robot " << i;
    }
  }
}

// The twist of the frame between two poses a time 2h apart.
Vector6d twist(const Eigen::Isometry3d& before, const Eigen::Isometry3d& after, double h) {
  const Eigen::AngleAxisd turned(Eigen::Matrix3d(after.linear() * before.linear().transpose()));
  Vector6d rate;
  rate << after.translation() - before.translation(), turned.angle() * turned.axis();
  return rate / (2.0 * h);
}

class KinematicsOf : public testing::TestWithParam<int> {
 protected:
  RandomRobot random_{static_cast<unsigned>(70 + GetParam())};
  TempFolder folder_;
  RobotModel model_ =
      RobotModel::read(GetParam() == 0 ? pa10 : folder_.write("robot.urdf", random_.urdf(8)));
  // The frame of the last body, away from its origin.
  Kinematics kinematics_{model_, model_.bodies.back().link, random_.pose()};
  int n_ = model_.dof();
};

TEST_P(KinematicsOf, JacobianIsTheDerivativeOfThePose) {
  constexpr double h = 1e-5;
  for (int k = 0; k < 5; ++k) {
    const Eigen::VectorXd q = random_.vector(n_, 2.0);
    const Eigen::VectorXd qd = random_.vector(n_, 1.0);
    kinematics_.move_to(q - h * qd);
    const Eigen::Isometry3d before = kinematics_.X_base_tool();
    kinematics_.move_to(q + h * qd);
    const Eigen::Isometry3d after = kinematics_.X_base_tool();
    kinematics_.move_to(q);
    EXPECT_LT((kinematics_.jacobian() * qd - twist(before, after, h)).norm(), 1e-8);
  }
}

TEST_P(KinematicsOf, WhatComesOfMovingOnIsThatOfDifferences) {
  constexpr double h = 1e-4;
  for (int k = 0; k < 5; ++k) {
    const Eigen::VectorXd q = random_.vector(n_, 2.0);
    const Eigen::VectorXd qd = random_.vector(n_, 1.0);
    const Vector6d wrench = random_.vector(6, 1.0);
    const Vector6d rate = random_.vector(6, 1.0);
    const auto jacobian = [&](double t) {
      kinematics_.move_to(q + t * qd);
      return kinematics_.jacobian();
    };
    const auto torques = [&](double t) -> Eigen::VectorXd {
      return jacobian(t).transpose() * (wrench + t * rate);
    };
    const Eigen::VectorXd bend = (torques(h) - 2.0 * torques(0.0) + torques(-h)) / (h * h);
    const Vector6d drift = (jacobian(h) - jacobian(-h)) * qd / (2.0 * h);
    Eigen::VectorXd curvature(n_);
    kinematics_.move_to(q);
    EXPECT_LT((kinematics_.move_on(qd, {wrench, rate}, curvature) - drift).norm(), 1e-6);
    EXPECT_LT((curvature - bend).norm(), 1e-5);
  }
}

TEST_P(KinematicsOf, PoseElsewhereIsThatOfGoingThere) {
  const Eigen::VectorXd q = random_.vector(n_, 2.0);
  const Eigen::Isometry3d there = kinematics_.pose_at(q);
  EXPECT_FALSE(there.isApprox(kinematics_.X_base_tool()));
  kinematics_.move_to(q);
  EXPECT_EQ(there.matrix(), kinematics_.X_base_tool().matrix());
}

TEST_P(KinematicsOf, WrenchGradientIsTheDerivativeOfTheTorques) {
  constexpr double h = 1e-5;
  const Eigen::VectorXd q = random_.vector(n_, 2.0);
  const Vector6d wrench = random_.vector(6, 1.0);
  Eigen::MatrixXd gradient(n_, n_);
  kinematics_.move_to(q);
  kinematics_.wrench_gradient(wrench, gradient);
  for (int i = 0; i < n_; ++i) {
    const auto torques = [&](double by) -> Eigen::VectorXd {
      kinematics_.move_to(q + by * Eigen::VectorXd::Unit(n_, i));
      return kinematics_.jacobian().transpose() * wrench;
    };
    EXPECT_LT((gradient.col(i) - (torques(h) - torques(-h)) / (2.0 * h)).norm(), 1e-8) << i;
  }
}

TEST_P(KinematicsOf, EvaluatesWithoutAllocating) {
  const Eigen::VectorXd q = random_.vector(n_, 2.0);
  Eigen::MatrixXd gradient(n_, n_);
  Eigen::VectorXd curvature(n_);
  const AllocationGuard guard;
  EXPECT_TRUE(kinematics_.pose_at(q).matrix().allFinite());
  kinematics_.move_to(q);
  kinematics_.wrench_gradient(Vector6d::Ones(), gradient);
  kinematics_.move_on(q, {Vector6d::Ones(), Vector6d::Ones()}, curvature);
  EXPECT_EQ(guard.allocations(), 0);
}

INSTANTIATE_TEST_SUITE_P(, KinematicsOf, testing::Range(0, 8));

TEST(Kinematics, RefusesAFrameThatNothingMoves) {
  const RobotModel model = RobotModel::read(pa10);
  EXPECT_THAT(test::refusal([&] { Kinematics(model, "base"); }),
              testing::HasSubstr("is moved by no joint"));
  EXPECT_NE(test::refusal([&] { Kinematics(model, "hook"); }), "");
}

}  // namespace
}  // namespace seam
