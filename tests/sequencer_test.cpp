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
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
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

// Discrete, rhythmic, discrete: the whole sequence against an independent solution, with joins at any phase.
TEST(Sequencer, AgreesWithAnIndependentSolutionOfTheWholeSequence) {
  for (const Join method : {Join::dmp2a, Join::dmp3}) {
    std::mt19937_64 random(24);
    const Primitive parts[] = {test::random_primitive(random, 2),
                               test::random_primitive(random, 2, 20, Kind::rhythmic),
                               test::random_primitive(random, 2, 12)};
    Sequence sequence;
    sequence.then(parts[0])
        .until(after(0.6))
        .then(parts[1])
        .enter(from_phase(2.0))
        .until(after(0.8))
        .then(parts[2]);
    const Sample start = Sample::at_rest(parts[0].start_position);
    Sequencer sequencer(sequence, method, start);
    const auto joined = [&](const Primitive& primitive, const test::Ode* before) {
      const double phase = primitive.kind == Kind::rhythmic ? 2.0 : 1.0;
      test::Ode ode(primitive, 1, before ? before->y : test::Ode::Real(start.position(1)),
                    before ? before->yd : 0.0L, phase);
      const test::Ode::Real ydd = before ? before->acceleration() : 0.0L;
      method == Join::dmp3 ? ode.join_dmp3(ydd) : ode.join_dmp2a(ydd);
      return ode;
    };
    test::Ode ode = joined(parts[0], nullptr);
    double worst = 0.0;
    double low = start.position(1);
    double high = low;
    for (int k = 1; k <= 2000; ++k) {
      sequencer.step(1e-3);
      ode.advance(1e-3L, 10);
      const double y = sequencer.sample().position(1);
      worst = std::max(worst, std::abs(y - static_cast<double>(ode.y)));
      low = std::min(low, y), high = std::max(high, y);
      if (k == 600) ode = joined(parts[1], &ode);
      if (k == 1400) ode = joined(parts[2], &ode);
    }
    EXPECT_LT(worst / (high - low), 1e-9) << to_string(method);
    EXPECT_EQ(sequencer.joins(), 3);
  }
}

Primitive slow(Kind kind) {
  std::mt19937_64 random(30);
  Primitive primitive = test::random_primitive(random, 2, 10, kind);
  primitive.tau = kind == Kind::discrete ? 1.0 : 0.5 / M_PI;  // a period of 1 s
  return primitive;
}

// Time at which a primitive with a switch hands over to the next.
double handed_over_at(Kind kind, const Switch& until, const Entry& entry = {}) {
  Sequence sequence;
  sequence.then(slow(kind)).until(until);
  if (kind == Kind::rhythmic) sequence.enter(entry);
  sequence.then(slow(Kind::discrete));
  Sequencer sequencer(sequence, Join::dmp3, Sample::at_rest(slow(kind).start_position));
  for (int k = 0; k < 10000 && sequencer.joins() < 2; ++k) sequencer.step(1e-3);
  return sequencer.joins() == 2 ? sequencer.join(1).time : INFINITY;
}

TEST(Switch, ComesAtItsTime) {
  EXPECT_DOUBLE_EQ(handed_over_at(Kind::discrete, after(0.3004)), 0.3004);
  EXPECT_DOUBLE_EQ(handed_over_at(Kind::discrete, before_end(0.4)), 0.6);
  EXPECT_NEAR(handed_over_at(Kind::discrete, at_phase(0.5)), 0.5 * std::log(2.0), 1e-12);
  EXPECT_NEAR(handed_over_at(Kind::rhythmic, after_cycles(2.5)), 2.5, 1e-12);
  EXPECT_NEAR(handed_over_at(Kind::rhythmic, after_cycles(2.0), from_phase(3.0)), 2.0, 1e-12);
  EXPECT_NEAR(handed_over_at(Kind::rhythmic, at_phase(M_PI)), 0.5, 1e-12);
  EXPECT_NEAR(handed_over_at(Kind::rhythmic, at_phase(M_PI), from_phase(1.5 * M_PI)), 0.75, 1e-12);
}

TEST(Switch, NearTheGoalComesAtTheFirstTickThatIsNear) {
  const double time = handed_over_at(Kind::discrete, near_goal(0.02));
  Execution alone(slow(Kind::discrete));
  alone.reinitialise(Sample::at_rest(alone.sample().position), 1.0, Join::dmp3);
  int ticks = 0;
  for (; (alone.goal() - alone.sample().position).cwiseAbs().maxCoeff() > 0.02; ++ticks)
    alone.step(1e-3);
  EXPECT_NEAR(time, 1e-3 * ticks, 1e-9);
  EXPECT_GT(ticks, 100);
}

TEST(Switch, OnCallComesWhenCalledAndNotBefore) {
  Sequence sequence;
  sequence.then(slow(Kind::discrete)).until(on_call()).then(slow(Kind::discrete));
  Sequencer sequencer(sequence, Join::dmp2a, Sample::at_rest(Eigen::Vector2d::Zero()));
  for (int k = 0; k < 5000; ++k) sequencer.step(1e-3);
  EXPECT_EQ(sequencer.running(), 0);
  EXPECT_TRUE(sequencer.hand_over());
  EXPECT_EQ(sequencer.running(), 1);
  EXPECT_TRUE(sequencer.hand_over());
  EXPECT_TRUE(sequencer.finished());
  EXPECT_FALSE(sequencer.hand_over());
}

TEST(Switch, OnCallEndsARhythm) {
  Sequence sequence;
  sequence.then(slow(Kind::rhythmic)).until(on_call());
  Sequencer sequencer(sequence, Join::dmp3, Sample::at_rest(slow(Kind::rhythmic).start_position));
  for (int k = 0; k < 2500; ++k) sequencer.step(1e-3);
  EXPECT_FALSE(sequencer.finished());
  EXPECT_TRUE(sequencer.hand_over());
  EXPECT_TRUE(sequencer.finished());
  for (int k = 0; k < 5000; ++k) sequencer.step(1e-3);
  EXPECT_LT((sequencer.sample().position - slow(Kind::rhythmic).goal).cwiseAbs().maxCoeff(), 1e-3);
}

// A change of tau that puts the switch into the past: it comes with the next step, and nothing jumps.
TEST(Switch, ThatIsOverdueComesAtOnceWithoutAJump) {
  Sequence sequence;
  sequence.then(slow(Kind::discrete)).until(before_end(0.6)).then(slow(Kind::discrete));
  Sequencer sequencer(sequence, Join::dmp2a, Sample::at_rest(Eigen::Vector2d::Zero()));
  for (int k = 0; k < 300; ++k) sequencer.step(1e-3);
  ASSERT_TRUE(sequencer.set_tau(0.3));
  const Sample before = sequencer.sample();
  sequencer.step(1e-6);
  EXPECT_EQ(sequencer.running(), 1);
  EXPECT_LT((sequencer.sample().position - before.position).norm(), 1e-5);
  EXPECT_LT((sequencer.sample().velocity - before.velocity).norm(), 1e-3);
}

// Every method, every join of a longer queue, and what a sequencer can be told on the way.
TEST(Sequencer, DoesAnythingWithoutAllocating) {
  for (const Join method : all_joins) {
    Sequence sequence;
    sequence.start_after(0.01).then(slow(Kind::discrete)).until(near_goal(0.5));
    sequence.then(slow(Kind::rhythmic)).enter(least_correction()).until(after_cycles(0.5));
    sequence.then(slow(Kind::discrete))
        .until(after(0.2))
        .then(slow(Kind::rhythmic))
        .until(on_call());
    Sequencer sequencer(sequence, method, Sample::at_rest(Eigen::Vector2d::Zero()));
    const Eigen::VectorXd goal = Eigen::Vector2d(0.3, -0.2);
    const Sample measured = sequencer.sample();
    const AllocationGuard guard;
    for (int k = 0; k < 3000; ++k) {
      if (k == 100) sequencer.set_goal(goal);
      if (k == 200) sequencer.set_tau(0.8);
      if (k == 300) sequencer.set_rate(0.5, 0.1);
      if (k == 350) sequencer.set_rate(1.0, 0.1);
      if (k == 500) sequencer.reinitialise(measured);
      if (k == 2500) sequencer.hand_over();
      sequencer.set_amplitude(1.1);
      sequencer.step(1e-3);
    }
    EXPECT_EQ(guard.allocations(), 0) << to_string(method);
    EXPECT_TRUE(sequencer.sample().position.allFinite());
  }
}

TEST(Switch, FollowsAChangeOfTau) {
  Sequence sequence;
  sequence.then(slow(Kind::discrete)).until(before_end(0.2)).then(slow(Kind::discrete));
  Sequencer sequencer(sequence, Join::dmp2a, Sample::at_rest(Eigen::Vector2d::Zero()));
  for (int k = 0; k < 500; ++k) sequencer.step(1e-3);
  ASSERT_TRUE(sequencer.set_tau(2.0));
  while (sequencer.joins() < 2) sequencer.step(1e-3);
  EXPECT_NEAR(sequencer.join(1).time, 0.5 + 1.0 - 0.2, 1e-9);  // the other half takes twice as long
}

TEST(Queue, CanBeExtendedReplacedAndClearedWhileItRuns) {
  Sequence one;
  one.then(slow(Kind::discrete));
  Sequence three = one;
  three.then(slow(Kind::discrete)).then(slow(Kind::discrete));
  Sequencer sequencer(three, Join::dmp3, Sample::at_rest(Eigen::Vector2d::Zero()));
  sequencer.step(0.5);
  sequencer.replace(one);
  sequencer.step(1.0);
  EXPECT_EQ(sequencer.running(), 1);
  sequencer.step(1.0);
  EXPECT_TRUE(sequencer.finished());
  sequencer.append(three);
  EXPECT_FALSE(sequencer.finished());
  EXPECT_EQ(sequencer.running(), 2);
  sequencer.clear();
  for (int k = 0; k < 12000; ++k) sequencer.step(1e-3);
  EXPECT_TRUE(sequencer.finished());
  EXPECT_EQ(sequencer.running(), 2);
  EXPECT_LT((sequencer.sample().position - slow(Kind::discrete).goal).cwiseAbs().maxCoeff(), 1e-3);
  Sequence other;
  Primitive renamed = slow(Kind::discrete);
  renamed.coordinates = {"a", "b"};
  other.then(renamed);
  EXPECT_EQ(test::refusal([&] { sequencer.append(other); }),
            "sequencer: the coordinates that are added differ from those that are there");
}

TEST(Queue, EndsARhythmSmoothlyAtItsCentre) {
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
    Sequence sequence;
    sequence.then(slow(Kind::rhythmic)).until(after_cycles(1.3));
    Sequencer sequencer(sequence, method, Sample::at_rest(slow(Kind::rhythmic).start_position));
    while (!sequencer.finished()) sequencer.step(1e-3);
    const JoinEvent& end = sequencer.join(1);
    EXPECT_NEAR(end.time, 1.3, 1e-9);
    EXPECT_LT((end.acceleration_after - end.acceleration_before).cwiseAbs().maxCoeff(), 1e-10);
    for (int k = 0; k < 5000; ++k) sequencer.step(1e-3);
    EXPECT_LT((sequencer.sample().position - slow(Kind::rhythmic).goal).cwiseAbs().maxCoeff(),
              1e-3);
    EXPECT_LT(sequencer.sample().velocity.cwiseAbs().maxCoeff(), 1e-2);
  }
}

TEST(Sequencer, ContinuesFromAMeasuredState) {
  const Played played(31);
  Sequencer sequencer(played.sequence, Join::dmp2a, played.start);
  sequencer.step(0.3);
  Sample measured = sequencer.sample();
  measured.position(0) += 0.05;
  measured.velocity(1) -= 0.2;
  ASSERT_TRUE(sequencer.reinitialise(measured));
  EXPECT_LT((sequencer.sample().position - measured.position).norm(), 1e-14);
  EXPECT_EQ(sequencer.sample().velocity, measured.velocity);
  EXPECT_LT((sequencer.sample().acceleration - measured.acceleration).norm(), 1e-10);
  measured.position(0) = NAN;
  EXPECT_FALSE(sequencer.reinitialise(measured));
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
