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
  fading.add_to(reference);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
