#include <gtest/gtest.h>

#include "tests/support.hpp"
#include <seam/sequencer.hpp>
#include <seam/time_scale.hpp>

namespace seam {
namespace {

TEST(TimeScale, RunsAsRealTimeUntilItIsChanged) {
  TimeScale scale;
  EXPECT_TRUE(scale.is_real_time());
  EXPECT_EQ(scale.advance(0.3), 0.3);
}

TEST(TimeScale, GivesTheIntegralOfItsRate) {
  TimeScale scale;
  ASSERT_TRUE(scale.change(0.2, 0.5));
  double time = 0.0;
  double sum = 0.0;
  for (int k = 0; k < 8000; ++k) {
    const double before = scale.rate();
    time += scale.advance(1e-4);
    sum += 0.5e-4 * (before + scale.rate());
  }
  EXPECT_NEAR(time, sum, 1e-8);
  EXPECT_NEAR(time, 0.5 * 0.6 + 0.3 * 0.2, 1e-12);
  EXPECT_FALSE(scale.is_real_time());
}

// Changed in the midst of other moves, at random and by orders of magnitude: rate, slope and curvature go on as they were, and
// the rate goes no further than it must.
TEST(TimeScale, MovesOnSmoothlyFromTheMidstOfAMoveAndHardlyBeyondItsEnds) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto magnitude = [&] { return std::pow(10.0, 3.0 * uniform(random) - 3.0); };
  TimeScale scale;
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE("seed 41, case " + std::to_string(i));
    const double rate = scale.rate();
    const double slope = scale.rate_change();
    const double curvature = scale.rate_curvature();
    const double to = i % 5 == 0 ? 0.0 : i % 5 == 1 ? rate : 3.0 * uniform(random);
    const double over = magnitude();
    ASSERT_TRUE(scale.change(to, over));
    ASSERT_NEAR(scale.rate(), rate, 1e-13);
    ASSERT_NEAR(scale.rate_change(), slope, 1e-12 * (1.0 + std::abs(slope)));
    ASSERT_NEAR(scale.rate_curvature(), curvature, 1e-10 * (1.0 + std::abs(curvature)));
    const double beyond = 0.1 * std::max(1.0, rate);
    const double least = std::min(to, rate - std::min(beyond, 0.5 * rate));
    const double most = std::max(to, rate + beyond);
    const double until = over * (i % 7 == 0 ? 1.1 : uniform(random));
    for (int k = 0; k < 100; ++k) {
      ASSERT_GE(scale.advance(0.01 * until), 0.0);
      ASSERT_GE(scale.rate(), least - 1e-12);
      ASSERT_LE(scale.rate(), most + 1e-12);
    }
    ASSERT_TRUE(until < over || scale.rate() == to);
  }
}

// Its slope, curvature and time are those of the rate, by finite differences.
TEST(TimeScale, AgreesWithItselfInTheMidstOfMoves) {
  TimeScale scale;
  ASSERT_TRUE(scale.change(2.0, 0.1));
  scale.advance(0.03);
  ASSERT_TRUE(scale.change(0.3, 0.2));
  constexpr double h = 1e-6;
  const auto at = [&](double time) {
    TimeScale then = scale;
    then.advance(time);
    return then;
  };
  for (int k = 1; k < 200; ++k) {
    const double time = 1e-3 * k + 0.5e-3;
    TimeScale now = at(time);
    EXPECT_NEAR((at(time + h).rate() - at(time - h).rate()) / (2.0 * h), now.rate_change(), 1e-4);
    EXPECT_NEAR((at(time + h).rate_change() - at(time - h).rate_change()) / (2.0 * h),
                now.rate_curvature(), 0.1);
    const double rate = now.rate();
    const double change = now.rate_change();
    EXPECT_NEAR(now.advance(h) / h, rate + 0.5 * h * change, 1e-8);
  }
}

// A move to 2 that is called back half-way, however fast it was.
TEST(TimeScale, IsCalledBackWithoutClimbingOn) {
  for (const double over : {0.1, 0.01, 0.001, 1e-6}) {
    TimeScale scale;
    ASSERT_TRUE(scale.change(2.0, over));
    scale.advance(0.5 * over);
    ASSERT_TRUE(scale.change(1.0, 0.5));
    double largest = 0.0;
    for (int k = 0; k < 100000; ++k) {
      scale.advance(k < 50000 ? over / 50000.0 : 1e-5);
      largest = std::max(largest, scale.rate());
    }
    EXPECT_LE(largest, 1.65) << over;
    EXPECT_EQ(scale.rate(), 1.0);
  }
}

TEST(TimeScale, RefusesWhatWillNotDo) {
  TimeScale scale;
  EXPECT_FALSE(scale.change(-1.0, 0.5));
  EXPECT_FALSE(scale.change(NAN, 0.5));
  EXPECT_FALSE(scale.change(1.0, 0.0));
  EXPECT_TRUE(scale.is_real_time());
}

Sequencer moving() {
  std::mt19937_64 random(40);
  const Primitive primitive = test::random_primitive(random, 2);
  Sequence sequence;
  sequence.then(primitive).until(after(0.5)).then(primitive);
  return {sequence, Join::dmp2a, Sample::at_rest(primitive.start_position)};
}

// Slower, faster, paused and on again: velocity and acceleration are the derivatives of the position all the way, and the
// acceleration has no step.
TEST(Rate, ChangesSmoothlyAtAnyTime) {
  const double dt = 1e-5;
  Sequencer sequencer = moving();
  Sample a = sequencer.sample();
  Sample b = a;
  double largest_change = 0.0;
  for (int k = 0; k < 150000; ++k) {
    if (k == 20000) sequencer.set_rate(0.4, 0.2);
    if (k == 30000) sequencer.set_rate(1.5, 0.1);
    if (k == 35000) sequencer.set_rate(0.0, 0.15);
    if (k == 100000) sequencer.set_rate(1.0, 0.2);
    sequencer.step(dt);
    const Sample& c = sequencer.sample();
    if (k > 1) {
      ASSERT_LT(((c.position - a.position) / (2.0 * dt) - b.velocity).norm(), 1e-4) << k;
      largest_change = std::max(largest_change, (c.acceleration - b.acceleration).norm());
    }
    a = b;
    b = c;
  }
  EXPECT_LT(largest_change, 0.1);
  EXPECT_EQ(sequencer.rate(), 1.0);
  EXPECT_NEAR(sequencer.time(), 1.5, 1e-9);
}

TEST(Rate, PausesAnArmThatMovesAndKeepsItsPath) {
  Sequencer paused = moving();
  Sequencer plain = moving();
  for (int k = 0; k < 200; ++k) paused.step(1e-3);
  ASSERT_GT(paused.sample().velocity.norm(), 0.1);
  ASSERT_TRUE(paused.set_rate(0.0, 0.1));
  for (int k = 0; k < 5000; ++k) paused.step(1e-3);
  EXPECT_EQ(paused.sample().velocity.norm(), 0.0);
  EXPECT_EQ(paused.sample().acceleration.norm(), 0.0);
  for (int k = 0; k < 250; ++k) plain.step(1e-3);  // 0.2 s, and half of the 0.1 s
  EXPECT_LT((paused.sample().position - plain.sample().position).norm(), 1e-9);
  ASSERT_TRUE(paused.set_rate(1.0, 0.1));
  while (!paused.finished()) paused.step(1e-3);
  while (!plain.finished()) plain.step(1e-3);
  EXPECT_EQ(paused.joins(), 2);
}

}  // namespace
}  // namespace seam
