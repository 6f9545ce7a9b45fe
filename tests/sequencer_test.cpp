#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/ode.hpp"
#include "tests/support.hpp"
#include <seam/sequencer.hpp>

namespace seam {
namespace {

struct Played {
  Sequence sequence;
  Sample start;

  explicit Played(unsigned seed, double delay = 0.0, double switch_at = 0.6) : start(2) {
    std::mt19937_64 random(seed);
    const Primitive first = test::random_primitive(random, 2);
    const Primitive second = test::random_primitive(random, 2, 12);
    sequence.start_after(delay).then(first).until(after(switch_at)).then(second);
    start = Sample::at_rest(first.start_position);
  }
};

TEST(Sequencer, JoinsWithContinuousAccelerationAlsoAtTheStart) {
  for (const Join method : {Join::dmp2a, Join::dmp3}) {
    const Played played(20, 0.1);
    Sequencer sequencer(played.sequence, method, played.start);
    while (!sequencer.finished()) sequencer.step(1e-3);
    ASSERT_EQ(sequencer.joins(), 2);
    for (int i = 0; i < 2; ++i) {
      const JoinEvent& join = sequencer.join(i);
      EXPECT_LT((join.acceleration_after - join.acceleration_before).cwiseAbs().maxCoeff(), 1e-11)
          << to_string(method) << " join " << i;
    }
    EXPECT_NEAR(sequencer.join(0).time, 0.1, 1e-12);
    EXPECT_NEAR(sequencer.join(1).time, 0.7, 1e-12);
    EXPECT_TRUE(sequencer.join(0).acceleration_before.isZero());
  }
}

TEST(Sequencer, StepsInAccelerationWithDmp2) {
  const Played played(20, 0.1);
  Sequencer sequencer(played.sequence, Join::dmp2, played.start);
  while (!sequencer.finished()) sequencer.step(1e-3);
  for (int i = 0; i < 2; ++i)
    EXPECT_GT((sequencer.join(i).acceleration_after - sequencer.join(i).acceleration_before)
                  .cwiseAbs()
                  .maxCoeff(),
              1.0);
}

TEST(Sequencer, HoldsTheStartUntilTheFirstPrimitiveBegins) {
  const Played played(21, 0.05);
  Sequencer sequencer(played.sequence, Join::dmp3, played.start);
  for (int i = 0; i < 49; ++i) {
    sequencer.step(1e-3);
    EXPECT_EQ(sequencer.running(), -1);
    EXPECT_EQ(sequencer.sample().position, played.start.position);
  }
  sequencer.step(1e-3);
  EXPECT_EQ(sequencer.running(), 0);
  EXPECT_EQ(sequencer.joins(), 1);
}

// A switch between two ticks happens at its own time: the path does not depend on where the ticks
// lie.
TEST(Sequencer, SwitchesInsideAStepExactlyWhenDue) {
  const Played played(22, 0.0, 0.6003);
  Sequencer aligned(played.sequence, Join::dmp2a, played.start);
  Sequencer between(played.sequence, Join::dmp2a, played.start);
  for (int i = 0; i < 10000; ++i) aligned.step(1e-4);
  for (int i = 0; i < 250; ++i) between.step(4e-3);
  EXPECT_LT((aligned.sample().position - between.sample().position).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(between.join(1).time, 0.6003, 1e-12);
}

TEST(Sequencer, TakesSeveralSwitchesWithinOneStep) {
  const Played played(23, 0.1, 0.2);
  Sequencer sequencer(played.sequence, Join::dmp3, played.start);
  sequencer.step(100.0);
  EXPECT_TRUE(sequencer.finished());
  EXPECT_EQ(sequencer.joins(), 2);
  EXPECT_NEAR(sequencer.time(), 100.0, 1e-9);
  EXPECT_LT((sequencer.sample().position - played.sequence.steps()[1].primitive.goal).norm(), 1e-3);
}

// The whole sequence against an independent solution, joined by Eq. 6 written out here in its
// printed form.
TEST(Sequencer, AgreesWithAnIndependentSolutionOfTheWholeSequence) {
  const Played played(24);
  Sequencer sequencer(played.sequence, Join::dmp3, played.start);
  const Primitive& first = played.sequence.steps()[0].primitive;
  const Primitive& second = played.sequence.steps()[1].primitive;
  const auto joined = [](const Primitive& primitive, int d, test::Ode::Real y, test::Ode::Real yd,
                         test::Ode::Real ydd) {
    test::Ode ode(primitive, d, static_cast<double>(y), static_cast<double>(yd));
    ode.y = y, ode.yd = yd;
    const auto& g = primitive.gains;
    ode.r = (ode.tau * ode.tau * ydd + g.D * ode.tau * yd - ode.forcing(1.0L)) / g.K + y;
    return ode;
  };
  const int d = 1;
  test::Ode ode = joined(first, d, played.start.position(d), 0.0L, 0.0L);
  double worst = 0.0;
  for (int k = 1; k <= 1500; ++k) {
    sequencer.step(1e-3);
    ode.advance(1e-3L, 5);
    worst = std::max(worst, std::abs(sequencer.sample().position(d) - static_cast<double>(ode.y)));
    if (k == 600) ode = joined(second, d, ode.y, ode.yd, ode.acceleration());
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(Sequencer, RefusesAStartThatDoesNotFit) {
  const Played played(25, 0.1);
  const auto refused = [&](const Sample& start) {
    return test::refusal([&] { Sequencer(played.sequence, Join::dmp2, start); });
  };
  Sample start = played.start;
  start.velocity(0) = NAN;
  EXPECT_EQ(refused(start), "sequencer: start is not finite");
  EXPECT_EQ(refused(Sample(3)), "sequencer: start has 3 coordinates, the sequence 2");
  start.velocity(0) = 0.1;
  EXPECT_EQ(refused(start),
            "sequencer: start moves, must be at rest where the first primitive is delayed");
}

TEST(Sequencer, StepsWithoutAllocating) {
  const Played played(26, 0.02, 0.05);
  Sequencer sequencer(played.sequence, Join::dmp2a, played.start);
  const AllocationGuard guard;
  for (int i = 0; i < 200; ++i) sequencer.step(1.3e-3);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
