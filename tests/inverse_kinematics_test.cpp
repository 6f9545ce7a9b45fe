#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/inverse_kinematics.hpp>

namespace seam {
namespace {

using Status = InverseKinematics::Status;

const std::string pa10 = std::string(SEAM_ASSETS) + "/pa10/pa10.urdf";

constexpr double straight = 0.45 + 0.50 + 0.08 + 0.16;  // [m] shoulder to tool

struct Arm {
  RobotModel model = RobotModel::read(pa10);
  Kinematics kinematics{model, "tool"};
  PostureSettings posture{(Eigen::VectorXd(7) << 0.0, 0.6, 0.0, 1.2, 0.0, 0.8, 0.0).finished(), {}};
  InverseKinematics inverse{model, kinematics, posture};
};

// A closed path in front of the arm: an oval that the tool goes round in 2 s, nodding and turning.
ToolState on_path(double t) {
  const double w = M_PI;
  const auto wave = [&](double size, double times, double phase) {
    const double a = times * w;
    return Eigen::Vector3d(size * std::sin(a * t + phase), size * a * std::cos(a * t + phase),
                           -size * a * a * std::sin(a * t + phase));
  };
  const Eigen::Vector3d x = wave(0.06, 1, 1.5), y = wave(0.15, 1, 0.0), z = wave(0.05, 2, 0.3);
  const Eigen::Vector3d nod = wave(0.3, 1, 0.2);
  ToolState state;
  state.pose.translation() = Eigen::Vector3d(0.72 + x(0), y(0), 0.35 + z(0));
  state.pose.linear() = (Eigen::AngleAxisd(nod(0), Eigen::Vector3d::UnitX()) *
                         Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()))
                            .toRotationMatrix();
  state.velocity << x(1), y(1), z(1), nod(1), 0.0, 0.0;
  state.acceleration << x(2), y(2), z(2), nod(2), 0.0, 0.0;
  return state;
}

JointSolution solution_at(Arm& arm, double t) {
  JointSolution solution;
  EXPECT_EQ(arm.inverse.follow(on_path(t), solution), Status::exact) << t;
  return solution;
}

TEST(InverseKinematics, FollowsAPathExactly) {
  Arm arm;
  arm.inverse.reach(on_path(0.0).pose);
  double worst = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const JointSolution solution = solution_at(arm, k * 1e-3);
    arm.kinematics.move_to(solution.position);
    const Eigen::Isometry3d& X = arm.kinematics.X_base_tool();
    worst = std::max(worst, (X.translation() - on_path(k * 1e-3).pose.translation()).norm());
    worst = std::max(worst, (X.linear() - on_path(k * 1e-3).pose.linear()).norm());
  }
  EXPECT_LT(worst, 2e-12);
}

// A closed path of the tool is one of the joints, and where it begins does not matter.
TEST(InverseKinematics, DoesNotDependOnThePath) {
  Arm arm;
  const Eigen::VectorXd first = arm.inverse.reach(on_path(0.0).pose);
  JointSolution solution;
  for (int k = 0; k <= 2000; ++k) solution = solution_at(arm, k * 1e-3);
  EXPECT_LT((solution.position - first).norm(), 1e-10);
  for (int k = 0; k < 700; ++k) solution = solution_at(arm, k * 1e-3);
  Arm other;
  other.inverse.reach(on_path(0.699).pose);
  EXPECT_LT((solution_at(other, 0.699).position - solution.position).norm(), 1e-10);
}

TEST(InverseKinematics, VelocityAndAccelerationAreDerivatives) {
  constexpr double h = 1e-4;
  Arm arm;
  arm.inverse.reach(on_path(0.0).pose);
  for (int k = 0; k < 40; ++k) {
    const double t = 0.05 * k;
    for (double s = std::max(0.0, t - 0.05); s < t; s += 0.01) solution_at(arm, s);
    const JointSolution before = solution_at(arm, t - h);
    const JointSolution now = solution_at(arm, t);
    const JointSolution after = solution_at(arm, t + h);
    EXPECT_LT((now.velocity - (after.position - before.position) / (2.0 * h)).norm(), 1e-5) << t;
    EXPECT_LT((now.acceleration - (after.velocity - before.velocity) / (2.0 * h)).norm(), 1e-4)
        << t;
  }
}

// Nothing near the solution on the self-motion is nearer to the posture.
TEST(InverseKinematics, IsNearestToThePosture) {
  Arm arm;
  arm.inverse.reach(on_path(0.0).pose);
  const JointSolution solution = solution_at(arm, 0.0);
  arm.kinematics.move_to(solution.position);
  const Eigen::MatrixXd J = arm.kinematics.jacobian();
  const Eigen::VectorXd away = solution.position - arm.posture.rest;
  // What of the way to the posture does not move the tool.
  const Eigen::VectorXd free = away - J.completeOrthogonalDecomposition().solve(J * away);
  EXPECT_LT(free.norm(), 1e-10);
}

TEST(InverseKinematics, SaysHowFarAPoseIsOutOfReach) {
  Arm arm;
  Eigen::Isometry3d far = on_path(0.0).pose;
  far.translation() = Eigen::Vector3d(2.0, 0.0, 0.3);
  // Upper arm 0.45, forearm 0.5, wrist to tool 0.24: 1.19 m from the shoulder, straight.
  EXPECT_THAT(test::refusal([&] { arm.inverse.reach(far); }),
              testing::StartsWith("pose: out of reach by 0.8"));
}

TEST(InverseKinematics, LosesWhatLeavesItsReachAndKeepsTheLastSolution) {
  Arm arm;
  arm.inverse.reach(on_path(0.0).pose);
  JointSolution solution = solution_at(arm, 0.0);
  ToolState target = on_path(0.0);
  Status status = Status::exact;
  Eigen::VectorXd last;
  for (int k = 0; k < 1000 && (status == Status::exact || status == Status::damped); ++k) {
    last = solution.position;
    target.pose.translation().x() += 1e-3;
    status = arm.inverse.follow(target, solution);
  }
  EXPECT_EQ(status, Status::lost);
  EXPECT_EQ(solution.position, last);
  EXPECT_GT(target.pose.translation().x(), 0.9);
}

// Out to 1 mm short of where the arm is straight, and back, in 2 s.
ToolState stretching(double t) {
  const double w = M_PI;
  ToolState state;
  state.pose.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const double size = 0.5 * (straight - 1e-3 - 1.0);
  state.pose.translation() = Eigen::Vector3d(1.0 + size * (1.0 - std::cos(w * t)), 0.0, 0.315);
  state.velocity(0) = size * w * std::sin(w * t);
  state.acceleration(0) = size * w * w * std::cos(w * t);
  return state;
}

TEST(InverseKinematics, IsDampedNearASingularityAndSaysByHowMuchTheToolMisses) {
  constexpr double dt = 1e-3;
  Arm arm;
  arm.inverse.reach(stretching(0.0).pose);
  double farthest = 0.0;
  int damped = 0;
  JointSolution before, solution;
  for (int k = 0; k <= 2000; ++k) {
    const ToolState target = stretching(k * dt);
    const Status status = arm.inverse.follow(target, solution);
    ASSERT_TRUE(status == Status::exact || status == Status::damped) << k;
    arm.kinematics.move_to(solution.position);
    const double off =
        (arm.kinematics.X_base_tool().translation() - target.pose.translation()).norm();
    EXPECT_NEAR(solution.position_error, off, 1e-12);
    if (status == Status::exact) {
      EXPECT_LT(off, 2e-12);
    }
    farthest = std::max(farthest, off);
    damped += status == Status::damped ? 1 : 0;
    if (k > 0) {
      const Eigen::VectorXd middle = 0.5 * (before.velocity + solution.velocity);
      EXPECT_LT(((solution.position - before.position) / dt - middle).norm(), 2e-3) << k;
      EXPECT_LT((solution.acceleration - before.acceleration).norm(), 1.0) << k;
    }
    before = solution;
  }
  EXPECT_GT(damped, 100);
  EXPECT_LT(damped, 1500);
  EXPECT_GT(farthest, 1e-4);
  EXPECT_LT(farthest, 5e-3);
}

struct Difference {
  double position, velocity, acceleration;
};

// The same target from the last solution alone.
Difference from_afresh(Arm& afresh, const Eigen::VectorXd& last, const ToolState& target,
                       const JointSolution& solution) {
  JointSolution other;
  afresh.inverse.start(last);
  EXPECT_EQ(afresh.inverse.follow(target, other), Status::exact);
  return {(solution.position - other.position).norm(), (solution.velocity - other.velocity).norm(),
          (solution.acceleration - other.acceleration).norm()};
}

// Ticks of one length, of another, of changing ones, a time asked for again, a jump, a step back.
std::vector<double> times_of_every_kind() {
  std::vector<double> times;
  const auto go = [&](int count, auto&& length) {
    for (int k = 0; k < count; ++k)
      times.push_back((times.empty() ? 0.0 : times.back()) + length(k));
  };
  go(20, [](int) { return 1e-3; });
  go(20, [](int) { return 4e-3; });
  go(20, [](int k) { return 1e-3 * (1.0 + 0.5 * std::sin(5.0 * k)); });
  go(20, [](int k) { return k % 3 == 0 ? 0.0 : 1e-3; });
  go(20, [](int k) { return k == 10 ? 0.2 : 1e-3; });
  go(20, [](int k) { return k == 10 ? -0.05 : 1e-3; });
  go(20, [](int) { return -1e-3; });
  return times;
}

TEST(InverseKinematics, SolutionsBeforeTheLastMakeNoDifference) {
  Arm arm, other;
  Eigen::VectorXd last = arm.inverse.reach(on_path(0.0).pose);
  for (const double t : times_of_every_kind()) {
    const JointSolution solution = solution_at(arm, t);
    const Difference difference = from_afresh(other, last, on_path(t), solution);
    EXPECT_LT(difference.position, 1e-13) << t;
    EXPECT_LT(difference.velocity, 1e-9) << t;
    EXPECT_LT(difference.acceleration, 1e-8) << t;
    last = solution.position;
  }
}

TEST(InverseKinematics, FollowsFromWhereItIsStartedAnew) {
  Arm arm;
  arm.inverse.reach(on_path(0.0).pose);
  for (int k = 0; k < 10; ++k) solution_at(arm, k * 1e-3);
  Arm other;
  const Eigen::VectorXd q = other.inverse.reach(on_path(0.7).pose);
  arm.inverse.start(q);
  for (int k = 0; k < 10; ++k) {
    const JointSolution solution = solution_at(arm, 0.7 + k * 1e-3);
    EXPECT_LT(from_afresh(other, q, on_path(0.7 + k * 1e-3), solution).position, 1e-13) << k;
  }
}

TEST(InverseKinematics, GoesOnFromTheLastSolutionAfterAPoseThatHasNone) {
  Arm arm, other;
  arm.inverse.reach(on_path(0.0).pose);
  JointSolution solution;
  for (int k = 0; k < 10; ++k) solution = solution_at(arm, k * 1e-3);
  const JointSolution last = solution;
  ToolState nowhere = on_path(0.01);
  nowhere.pose.translation().x() = 3.0;
  EXPECT_EQ(arm.inverse.follow(nowhere, solution), Status::lost);
  nowhere.pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(arm.inverse.follow(nowhere, solution), Status::lost);
  EXPECT_EQ(solution.position, last.position);
  EXPECT_EQ(solution.velocity, last.velocity);
  for (int k = 10; k < 20; ++k) {
    solution = solution_at(arm, k * 1e-3);
    EXPECT_LT(from_afresh(other, last.position, on_path(k * 1e-3), solution).position, 1e-13) << k;
  }
}

TEST(InverseKinematics, FollowsWithoutAllocating) {
  Arm arm;
  arm.inverse.reach(on_path(0.0).pose);
  JointSolution solution = solution_at(arm, 0.0);
  for (const double t : times_of_every_kind()) {
    const ToolState next = on_path(t);
    const AllocationGuard guard;
    EXPECT_EQ(arm.inverse.follow(next, solution), Status::exact);
    EXPECT_EQ(guard.allocations(), 0) << t;
  }
}

TEST(InverseKinematics, RefusesSettingsThatDoNotFit) {
  Arm arm;
  const auto with = [&](const Eigen::VectorXd& rest, const Eigen::VectorXd& weight) {
    return test::refusal([&] { InverseKinematics(arm.model, arm.kinematics, {rest, weight}); });
  };
  EXPECT_THAT(with(Eigen::VectorXd::Zero(6), {}), testing::HasSubstr("rest must be 7 finite"));
  EXPECT_THAT(with({}, Eigen::VectorXd::Zero(7)), testing::HasSubstr("weight must be > 0"));
}

}  // namespace
}  // namespace seam
