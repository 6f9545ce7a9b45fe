#include <gtest/gtest.h>

#include "tests/allocation_guard.hpp"
#include <seam/fading_offset.hpp>

namespace seam {
namespace {

const Eigen::Vector2d offset(0.3, -0.1), velocity(-0.5, 1.2);

Sample at(double time) {
  FadingOffset fading(2);
  fading.start(offset, velocity);
  fading.advance(time);
  Sample reference(2);
  fading.add_to(reference);
  return reference;
}

TEST(FadingOffset, BeginsAsItIsToldAndEndsAtRestAtNothing) {
  EXPECT_LT((at(0.0).position - offset).norm(), 1e-15);
  EXPECT_LT((at(0.0).velocity - velocity).norm(), 1e-15);
  EXPECT_LT(at(0.0).acceleration.norm(), 1e-15);
  const Sample end = at(FadingOffset::duration - 1e-9);
  for (const Eigen::VectorXd* part : {&end.position, &end.velocity, &end.acceleration})
    EXPECT_LT(part->norm(), 1e-7);
  EXPECT_EQ(at(FadingOffset::duration).position, Eigen::VectorXd::Zero(2));
}

// By central differences, whose error is of order h².
TEST(FadingOffset, VelocityAndAccelerationAreTheDerivatives) {
  constexpr double h = 1e-5;
  for (const double t : {0.1, 0.35, 0.5, 0.92}) {
    const Eigen::VectorXd slope = (at(t + h).position - at(t - h).position) / (2.0 * h);
    const Eigen::VectorXd bend = (at(t + h).velocity - at(t - h).velocity) / (2.0 * h);
    EXPECT_LT((slope - at(t).velocity).norm(), 1e-8) << t;
    EXPECT_LT((bend - at(t).acceleration).norm(), 1e-7) << t;
  }
}

// Position, velocity and acceleration go on where another offset comes on top, but for what that adds.
TEST(FadingOffset, IsShiftedOnTheWayWithoutAStepInAcceleration) {
  const Eigen::Vector2d more(0.1, 0.2), faster(-0.3, 0.4);
  FadingOffset fading(2);
  fading.start(offset, velocity);
  fading.advance(0.4);
  Sample before(2), after(2);
  fading.add_to(before);
  fading.shift(more, faster);
  fading.add_to(after);
  EXPECT_LT((after.position - before.position - more).norm(), 1e-14);
  EXPECT_LT((after.velocity - before.velocity - faster).norm(), 1e-14);
  EXPECT_LT((after.acceleration - before.acceleration).norm(), 1e-12);
  constexpr double h = 1e-5;
  Sample sooner(2), now(2), later(2);
  for (Sample* sample : {&sooner, &now, &later}) {
    fading.advance(sample == &sooner ? 0.3 : h);
    fading.add_to(*sample);
  }
  EXPECT_LT(((later.position - sooner.position) / (2.0 * h) - now.velocity).norm(), 1e-8);
  EXPECT_LT(((later.velocity - sooner.velocity) / (2.0 * h) - now.acceleration).norm(), 1e-7);
  fading.advance(1.0);
  EXPECT_TRUE(fading.faded());
}

TEST(FadingOffset, OfNothingIsFadedAtOnce) {
  FadingOffset fading(2);
  EXPECT_TRUE(fading.faded());
  fading.start(Eigen::Vector2d(1e-15, 0.0), Eigen::Vector2d::Zero());
  EXPECT_TRUE(fading.faded());
  fading.start(offset, Eigen::Vector2d::Zero());
  EXPECT_FALSE(fading.faded());
}

TEST(FadingOffset, AllocatesNothing) {
  FadingOffset fading(2);
  Sample reference(2);
  const Eigen::VectorXd d = offset, v = velocity;
  const AllocationGuard guard;
  fading.start(d, v);
  fading.advance(0.1);
  fading.shift(d, v);
  fading.add_to(reference);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
