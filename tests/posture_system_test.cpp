#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/random_robot.hpp"
#include <seam/posture_system.hpp>

namespace seam {
namespace {

class PostureSystemOf : public testing::TestWithParam<int> {
 protected:
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    return random_.vector(rows * columns, 1.0).reshaped(rows, columns);
  }
  // Of what an arm has: a weight for each joint, and a part that is neither symmetric nor positive, but where the tool moves.
  Eigen::MatrixXd stiffness() {
    const Eigen::MatrixXd spread = matrix(n_, n_);
    return Eigen::MatrixXd::Identity(n_, n_) + spread * spread.transpose() +
           J_.transpose() * matrix(6, n_);
  }

  int n_ = GetParam();
  RandomRobot random_{static_cast<unsigned>(90 + n_)};
  Jacobian J_ = matrix(6, n_);
  PostureSystem system_;
};

TEST_P(PostureSystemOf, SolvesBothCasesAsTheWholeMatrixDoes) {
  for (int k = 0; k < 20; ++k) {
    J_ = matrix(6, n_);
    const Eigen::MatrixXd A = stiffness();
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n_ + 6, n_ + 6);
    whole << A, J_.transpose(), J_, Eigen::MatrixXd::Zero(6, 6);
    const Eigen::MatrixXd right = matrix(n_ + 6, 2);
    PostureSystem::Sides sides;
    for (int i = 0; i < n_ + 6; ++i) sides[i] = right.row(i);
    const AllocationGuard guard;
    EXPECT_GT(system_.choose(J_), 0.0);
    ASSERT_TRUE(system_.factor(A));
    system_.solve(sides);
    EXPECT_EQ(guard.allocations(), 0);
    const Eigen::MatrixXd expected = whole.fullPivLu().solve(right);
    for (int i = 0; i < n_ + 6; ++i)
      EXPECT_LT((sides[i].matrix().transpose() - expected.row(i)).norm(), 1e-9 * expected.norm())
          << "case " << k << ", row " << i;
  }
}

TEST_P(PostureSystemOf, VolumeOfTheChosenIsWithinThatOfAll) {
  for (int k = 0; k < 20; ++k) {
    J_ = matrix(6, n_);
    const double all = std::sqrt((J_ * J_.transpose()).determinant());
    const double chosen = system_.choose(J_);
    EXPECT_LE(chosen, all * (1.0 + 1e-12));
    EXPECT_GT(chosen, 0.0);
    if (n_ == 6) {
      EXPECT_NEAR(chosen, all, 1e-12 * all);
    }
  }
}

TEST_P(PostureSystemOf, SaysWhereItDoesNotDo) {
  J_.row(3) = J_.row(1);
  EXPECT_LT(system_.choose(J_), 1e-12);
  J_.row(3).setZero();
  EXPECT_EQ(system_.choose(J_), 0.0);
  J_.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(system_.choose(J_), 0.0);
  J_ = matrix(6, n_);
  system_.choose(J_);
  EXPECT_EQ(system_.factor(-stiffness()), n_ == 6);
}

INSTANTIATE_TEST_SUITE_P(, PostureSystemOf, testing::Values(6, 7, 9, PostureSystem::most));

}  // namespace
}  // namespace seam
