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

// Also in the midst of another move: rate, its change and the time that goes by are continuous, and never run backwards.
TEST(TimeScale, MovesOnSmoothlyFromTheMidstOfAMove) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  TimeScale scale;
  for (int i = 0; i < 200; ++i) {
    for (double left = 0.3 * uniform(random); left > 0.0; left -= 1e-3)
      EXPECT_GE(scale.advance(1e-3), 0.0);
    const double rate = scale.rate();
    const double change = scale.rate_change();
    ASSERT_TRUE(scale.change(i % 3 ? 2.0 * uniform(random) : 0.0, 0.05 + 0.3 * uniform(random)));
    EXPECT_NEAR(scale.rate(), rate, 1e-14);
    EXPECT_NEAR(scale.rate_change(), change, 1e-11);
    const double h = 1e-6;
    const double time = scale.advance(h);
    EXPECT_NEAR(time / h, rate, 1e-4) << "seed 41, case " << i;
    EXPECT_NEAR((scale.rate() - rate) / h, change, 1e-2) << "seed 41, case " << i;
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
