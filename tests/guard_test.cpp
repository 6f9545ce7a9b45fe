#include <limits>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/guard.hpp>

namespace seam {
namespace {

using Cause = Incident::Cause;

constexpr double dt = 1e-3;
constexpr double infinity = std::numeric_limits<double>::infinity();

// A turning joint with limits, one without, and one that slides.
RobotModel robot() {
  RobotModel model;
  model.joints.resize(3);
  model.bodies.resize(3);
  const char* const names[] = {"turn", "wheel", "slide"};
  for (std::size_t i = 0; i < 3; ++i) model.joints[i].name = names[i];
  model.joints[0].lower = -1.0;
  model.joints[0].upper = 2.0;
  model.joints[1].type = Joint::Type::continuous;
  model.joints[1].lower = -infinity;
  model.joints[1].upper = infinity;
  model.joints[2].type = Joint::Type::prismatic;
  model.joints[2].upper = 0.04;
  return model;
}

const Eigen::Vector3d rest = Eigen::Vector3d::Zero();
const Eigen::Vector3d moving(0.1, 0.0, 0.0);

TEST(Guard, TrustsAStateThatStandsWhileTheReferenceStands) {
  Guard guard(robot(), {});
  for (int k = 0; k < 1000; ++k) EXPECT_TRUE(guard.trusts(dt, rest, rest, rest));
}

TEST(Guard, TakesAStateThatStandsForNoneOnceTheReferenceHasMovedOn) {
  Guard guard(robot(), {});
  const auto trusts = [&](double q, double reference) {
    return guard.trusts(dt, Eigen::Vector3d(q, 0.0, 0.0), moving,
                        Eigen::Vector3d(reference, 0.0, 0.0));
  };
  EXPECT_TRUE(trusts(0.5, 0.5));
  EXPECT_TRUE(trusts(0.5, 0.509));
  EXPECT_FALSE(trusts(0.5, 0.511));
  EXPECT_FALSE(trusts(0.5, 0.5)) << "the reference came back, the state is still the same";
  EXPECT_DOUBLE_EQ(guard.dropout().value, 2.0 * dt);
  EXPECT_TRUE(trusts(std::nextafter(0.5, 1.0), 0.6));
  EXPECT_EQ(guard.dropout().value, 0.0);
}

TEST(Guard, LetsAnArmStandThatFrictionMayHold) {
  Guard guard(robot(), {});
  const auto trusts = [&](double reference) {
    return guard.trusts(dt, rest, rest, Eigen::Vector3d(reference, 0.0, 0.0));
  };
  EXPECT_TRUE(trusts(0.0));
  EXPECT_TRUE(trusts(0.29));
  EXPECT_FALSE(trusts(0.31));
}

TEST(Guard, LetsAStateThatIsLateStandForItsDelay) {
  Guard guard(robot(), {}, 0.05);
  for (const bool again : {false, true}) {
    for (int k = 0; k <= 50; ++k)
      EXPECT_TRUE(guard.trusts(dt, rest, moving, Eigen::Vector3d(0.01 * k, 0.0, 0.0))) << k;
    EXPECT_TRUE(guard.trusts(dt, rest, moving, Eigen::Vector3d(0.505, 0.0, 0.0)));
    EXPECT_FALSE(guard.trusts(dt, rest, moving, Eigen::Vector3d(0.515, 0.0, 0.0))) << again;
    guard.restart(rest);
  }
}

TEST(Guard, TakesAStateThatIsNotFiniteForNoneAndTellsWhenThatIsTooLong) {
  GuardSettings settings;
  settings.longest_dropout = 0.0205;
  for (const double bad : {std::nan(""), infinity}) {
    for (const bool position : {false, true}) {
      Guard guard(robot(), settings);
      Eigen::VectorXd q = rest, qd = rest;
      (position ? q : qd)(1) = bad;
      for (int k = 0; k < 20; ++k) EXPECT_FALSE(guard.trusts(dt, q, qd, rest));
      EXPECT_FALSE(guard.lost());
      EXPECT_FALSE(guard.trusts(dt, q, qd, rest));
      EXPECT_TRUE(guard.lost());
      EXPECT_TRUE(guard.trusts(dt, rest, rest, rest));
      EXPECT_FALSE(guard.lost());
    }
  }
}

TEST(Guard, TellsWhichJointIsOffItsReference) {
  GuardSettings settings;
  settings.most_error = Eigen::VectorXd(Eigen::Vector3d(0.2, infinity, 0.01));
  const Guard guard(robot(), settings);
  EXPECT_EQ(guard.deviation(Eigen::Vector3d(0.19, 1e6, -0.009), rest, false).cause, Cause::none);
  const Incident off = guard.deviation(Eigen::Vector3d(0.1, 0.0, -0.03), rest, false);
  EXPECT_EQ(off.cause, Cause::deviation);
  EXPECT_EQ(off.joint, 2);
  EXPECT_EQ(off.value, 0.03);
  EXPECT_EQ(off.bound, 0.01);
}

// A wrist that friction holds back is asked for little; one that is lost for all there is.
TEST(Guard, TakesAJointForLostWhereTheFeedbackAsksForMuch) {
  RobotModel model = robot();
  model.joints[0].effort = 17.0;
  model.joints[1].effort = infinity;
  model.joints[2].effort = 17.0;
  const Eigen::VectorXd stiffness =
      Eigen::Vector3d(10.0, 10.0, 1000.0);  // 0.85 and 0.0085 for half
  const Guard guard(model, {}, 0.0, stiffness);
  const auto joint = [&](double turn, double wheel, double slide, bool limited = false) {
    return guard.deviation(Eigen::Vector3d(turn, wheel, slide), rest, limited).joint;
  };
  EXPECT_EQ(joint(0.84, 0.29, 0.29), -1);
  EXPECT_EQ(joint(-0.86, 0.0, 0.0), 0);
  EXPECT_EQ(joint(0.0, 0.31, 0.0), 1) << "without an effort limit";
  EXPECT_EQ(joint(0.0, 0.0, 0.31), 2);
  EXPECT_EQ(joint(0.31, 0.0, 0.0, true), 0) << "a drive has no more to give";
  GuardSettings error_alone;
  error_alone.least_effort = 0.0;
  const Eigen::Vector3d far(0.31, 0.0, 0.0);
  EXPECT_EQ(Guard(model, error_alone, 0.0, stiffness).deviation(far, rest, false).joint, 0);
  EXPECT_EQ(Guard(model, {}).deviation(far, rest, false).joint, 0);
}

TEST(Guard, AllowsAShareOfTheRangeBeyondALimit) {
  const Guard guard(robot(), {});
  EXPECT_EQ(guard.beyond_limits(Eigen::Vector3d(2.029, 1e9, -0.0003)).cause, Cause::none);
  const Incident above = guard.beyond_limits(Eigen::Vector3d(2.031, 0.0, 0.0));
  EXPECT_EQ(above.cause, Cause::joint_limit);
  EXPECT_EQ(above.joint, 0);
  EXPECT_EQ(above.bound, 2.0);
  EXPECT_EQ(guard.beyond_limits(Eigen::Vector3d(-1.031, 0.0, 0.0)).bound, -1.0);
  EXPECT_EQ(guard.beyond_limits(Eigen::Vector3d(0.0, 0.0, -0.0005)).joint, 2);
}

TEST(Guard, LetsAJointThatIsBeyondALimitStayAndComeBack) {
  Guard guard(robot(), {});
  guard.restart(Eigen::Vector3d(2.5, 0.0, 0.0));
  EXPECT_EQ(guard.beyond_limits(Eigen::Vector3d(2.5, 0.0, 0.0)).cause, Cause::none);
  EXPECT_EQ(guard.beyond_limits(Eigen::Vector3d(1.0, 0.0, 0.0)).cause, Cause::none);
  EXPECT_EQ(guard.beyond_limits(Eigen::Vector3d(2.51, 0.0, 0.0)).bound, 2.0);
}

TEST(Guard, KeepsTheEndOfAMotionWithinTheLimits) {
  const Guard guard(robot(), {});
  const auto end = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    Eigen::VectorXd kept = to;
    guard.keep_within_limits(from, kept);
    return Eigen::Vector3d(kept);
  };
  EXPECT_EQ(end(rest, {7.0, 7.0, -7.0}), Eigen::Vector3d(2.0, 7.0, 0.0));
  EXPECT_EQ(end({2.1, 0.0, -1.0}, {7.0, 0.0, -7.0}), Eigen::Vector3d(2.1, 0.0, -1.0));
  EXPECT_EQ(end({2.1, 0.0, -1.0}, {1.0, 0.0, 0.01}), Eigen::Vector3d(1.0, 0.0, 0.01));
}

TEST(Guard, WatchesNothingWithInfiniteBounds) {
  GuardSettings off;
  off.most_error = off.longest_dropout = off.frozen_beyond = off.beyond_limits = infinity;
  Guard guard(robot(), off);
  const Eigen::VectorXd far = Eigen::Vector3d::Constant(1e9);
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(guard.trusts(dt, rest, rest, k * far));
  EXPECT_EQ(guard.deviation(far, rest, false).cause, Cause::none);
  EXPECT_EQ(guard.beyond_limits(far).cause, Cause::none);
  EXPECT_FALSE(guard.trusts(dt, Eigen::Vector3d::Constant(NAN), rest, rest));
  EXPECT_FALSE(guard.lost());
}

TEST(Guard, RefusesBoundsThatAreNone) {
  const auto refused = [](const GuardSettings& settings) {
    return test::refusal([&] { Guard(robot(), settings); });
  };
  GuardSettings settings;
  settings.most_error = -0.1;
  EXPECT_EQ(refused(settings), "guard: most_error: -0.100000, must be >= 0");
  settings.most_error = Eigen::VectorXd(Eigen::Vector2d::Ones());
  EXPECT_EQ(refused(settings), "guard: most_error: 2 numbers, must be 3, one for each joint");
  settings = {};
  settings.least_effort = -1.0;
  EXPECT_EQ(refused(settings), "guard: least_effort: -1.000000, must be >= 0");
  settings = {};
  settings.longest_dropout = NAN;
  EXPECT_EQ(refused(settings), "guard: longest_dropout: nan, must be >= 0");
}

TEST(Guard, IncidentsAreToldInOneLine) {
  EXPECT_EQ(describe({}, robot()), "nothing has happened");
  EXPECT_EQ(describe({Cause::no_state, 1.5, -1, 0.101, 0.1}, robot()),
            "from 1.5 s on there was no state of the joints for more than 0.1 s");
  EXPECT_EQ(describe({Cause::no_state, 1.5, -1, 0.04, 0.1}, robot()),
            "from 1.5 s on there was no state of the joints for 0.04 s, which was bridged");
  EXPECT_EQ(describe({Cause::deviation, 1.5, 2, 0.35, 0.3}, robot()),
            "at 1.5 s joint \"slide\" was off its reference by 0.35 m, the bound is 0.3");
  EXPECT_EQ(describe({Cause::goal, 0.0, 0, 3.5, 2.0}, robot()),
            "at 0 s joint \"turn\" was given the goal 3.5 rad, the bound is 2");
  EXPECT_EQ(describe({Cause::joint_limit, 0.0, 0, -1.1, -1.0}, robot()),
            "at 0 s joint \"turn\" was led to -1.1 rad, the bound is -1");
  EXPECT_EQ(describe({Cause::unreachable, 0.25, -1, 0.0, 0.0}, robot()),
            "at 0.25 s the sequence led where the tool cannot be");
}

TEST(Guard, AllocatesNothingAsItWatches) {
  Guard guard(robot(), {});
  Eigen::VectorXd q = rest, qd = rest, reference = rest;
  const AllocationGuard allocation;
  for (int k = 0; k < 100; ++k) {
    q(0) = k % 2 ? NAN : 0.01 * k;
    guard.trusts(dt, q, qd, reference);
    guard.deviation(q, reference, false);
    guard.beyond_limits(q);
  }
  EXPECT_EQ(allocation.allocations(), 0);
}

}  // namespace
}  // namespace seam
