#include <functional>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/joins.hpp"
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

test::Ode joined(const Primitive& primitive, const JoinSettings& join, double phase,
                 const test::Ode::Matrix& motion) {
  test::Ode ode(primitive);
  ode.join(motion, phase, join);
  return ode;
}

// Largest differences from an independent solution, a share of each coordinate's range, over 2 s of a discrete, a
// rhythmic and a discrete primitive; at ticks of 1 ms and of 0.5 ms.
Eigen::ArrayX2d error_of_the_whole(const JoinSettings& method, int D, double period,
                                   int ode_steps) {
  std::mt19937_64 random(24);
  Primitive parts[] = {test::random_primitive(random, D),
                       test::random_primitive(random, D, 20, Kind::rhythmic),
                       test::random_primitive(random, D, 12)};
  parts[1].tau = period / (2.0 * M_PI);
  Sequence sequence;
  sequence.then(parts[0]).until(after(0.6));
  sequence.then(parts[1]).enter(from_phase(2.0)).until(after(0.8)).then(parts[2]);
  Sample start = Sample::at_rest(parts[0].start_position);
  start.velocity = parts[0].start_velocity;
  start.acceleration = parts[0].start_acceleration;
  Sequencer at_1ms(sequence, method, start);
  Sequencer at_half = at_1ms;
  test::Ode::Matrix motion(D, 4);
  motion << start.position.cast<test::Ode::Real>(), start.velocity.cast<test::Ode::Real>(),
      start.acceleration.cast<test::Ode::Real>(), start.jerk.cast<test::Ode::Real>();
  test::Ode ode = joined(parts[0], method, 1.0, motion);
  Eigen::ArrayX2d worst = Eigen::ArrayX2d::Zero(D, 2);
  Eigen::ArrayXd low = start.position;
  Eigen::ArrayXd high = low;
  for (int k = 1; k <= 2000; ++k) {
    at_1ms.step(1e-3);
    for (int i = 0; i < 2; ++i) at_half.step(5e-4);
    ode.advance(1e-3L, ode_steps);
    const Eigen::ArrayXd y = ode.motion().col(0).cast<double>();
    worst.col(0) = worst.col(0).max((at_1ms.sample().position.array() - y).abs());
    worst.col(1) = worst.col(1).max((at_half.sample().position.array() - y).abs());
    low = low.min(y);
    high = high.max(y);
    if (k == 600) ode = joined(parts[1], method, 2.0, ode.motion());
    if (k == 1400) ode = joined(parts[2], method, 1.0, ode.motion());
  }
  EXPECT_EQ(at_1ms.joins(), 3);
  return worst.colwise() / (high - low);
}

// With a rhythm of 1 s; dmp2j, which changes weights by much more to keep its jerk, needs one of 2 s or shorter ticks.
TEST(Sequencer, AgreesWithAnIndependentSolutionOfTheWholeSequence) {
  for (const JoinSettings& method : test::all_methods())
    EXPECT_LT(error_of_the_whole(method, 5, method.method == Join::dmp2j ? 2.0 : 1.0, 10)
                  .col(0)
                  .maxCoeff(),
              1e-9)
        << test::word(method);
}

// A rhythm of 0.4 s needs shorter ticks for that: what is left falls with their fourth power.
TEST(Sequencer, IsOfFourthOrderInTheTick) {
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
    const double period = method == Join::dmp2j ? 1.0 : 0.4;
    const Eigen::ArrayX2d error = error_of_the_whole(method, 2, period, 30);
    EXPECT_LT(error.maxCoeff(), 1e-6) << to_string(method);
    EXPECT_GT((error.col(0) / error.col(1)).minCoeff(), 12.0) << to_string(method);
  }
}

// The step in acceleration that dmp2 leaves, entered at each of 180 phases: none is smaller than the one that is chosen.
TEST(Sequencer, EntersARhythmWhereTheLeastCorrectionIsNeeded) {
  std::mt19937_64 random(26);
  for (int i = 0; i < 10; ++i) {
    const Primitive reach = test::random_primitive(random, 2);
    const Primitive wipe = test::random_primitive(random, 2, 20, Kind::rhythmic);
    const auto played = [&](const Entry& entry, Join method) {
      Sequence sequence;
      sequence.then(reach).until(after(0.4)).then(wipe).enter(entry);
      Sequencer sequencer(sequence, method, Sample::at_rest(reach.start_position));
      sequencer.step(0.4);
      return sequencer;
    };
    const auto jump = [](const Sequencer& sequencer) {
      return (sequencer.join(1).acceleration_after - sequencer.join(1).acceleration_before).norm();
    };
    const double spacing = 2.0 * M_PI / 180.0;
    double least = INFINITY;
    for (int k = 0; k < 180; ++k)
      least = std::min(least, jump(played(from_phase(k * spacing), Join::dmp2)));
    const Sequencer plain = played(least_correction(), Join::dmp2);
    EXPECT_LE(jump(plain), least + 1e-9) << "seed 26, case " << i;
    EXPECT_NEAR(jump(played(from_phase(plain.phase()), Join::dmp2)), jump(plain), 1e-9);
    for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
      // The predecessor's own join changes the state at 0.4 s, and with it the phase.
      const Sequencer entered = played(least_correction(), method);
      EXPECT_EQ(entered.running(), 1);
      EXPECT_LT(jump(entered), 1e-10) << to_string(method) << ", seed 26, case " << i;
    }
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

TEST(Switch, ComesWhenTheSequenceSaysSo) {
  for (const Switch until : {after(0.7), after_cycles(1.5), at_phase(1.0), at_phase(-20.0)})
    for (const Entry& entry : {Entry{}, from_phase(1.0), from_phase(-3.0), from_phase(40.0)}) {
      Sequence sequence;
      sequence.then(slow(Kind::rhythmic)).until(until).enter(entry);
      const double expected = sequence.duration();
      EXPECT_GT(expected, 0.0);
      EXPECT_NEAR(handed_over_at(Kind::rhythmic, until, entry), expected, 1e-12);
    }
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

// At another rate the ticks are closer in the motion's time.
TEST(Switch, NearTheGoalComesAtTheFirstTickThatIsNearAtAnyRate) {
  for (const double rate : {0.3, 1.7}) {
    Sequence sequence;
    sequence.then(slow(Kind::discrete)).until(near_goal(0.02)).then(slow(Kind::discrete));
    const Sample start = Sample::at_rest(slow(Kind::discrete).start_position);
    Sequencer sequencer(sequence, Join::dmp3, start);
    Execution alone(slow(Kind::discrete));
    alone.reinitialise(start, 1.0, Join::dmp3);
    TimeScale clock;
    ASSERT_TRUE(clock.change(rate, 0.1));
    ASSERT_TRUE(sequencer.set_rate(rate, 0.1));
    int ticks = 0;
    for (; (alone.goal() - alone.sample().position).cwiseAbs().maxCoeff() > 0.02; ++ticks) {
      ASSERT_EQ(sequencer.running(), 0) << "tick " << ticks << " at rate " << rate;
      alone.step(clock.advance(1e-3));
      sequencer.step(1e-3);
    }
    EXPECT_EQ(sequencer.running(), 1);
    EXPECT_NEAR(sequencer.join(1).time, 1e-3 * ticks, 1e-9);
    EXPECT_GT(ticks, 100);
  }
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

TEST(Sequencer, CountsChangesButNotSteps) {
  Sequence sequence;
  sequence.then(slow(Kind::discrete)).until(after(0.01)).then(slow(Kind::rhythmic));
  Sequencer sequencer(sequence, Join::dmp3, Sample::at_rest(Eigen::Vector2d::Zero()));
  const unsigned before = sequencer.changes();
  for (int k = 0; k < 20; ++k) sequencer.step(1e-3);
  EXPECT_EQ(sequencer.joins(), 2);
  EXPECT_EQ(sequencer.changes(), before);
  const std::vector<std::function<void()>> changes = {
      [&] { sequencer.set_goal(Eigen::Vector2d(0.3, -0.2)); },
      [&] { sequencer.set_tau(0.8); },
      [&] { sequencer.set_amplitude(1.1); },
      [&] { sequencer.set_rate(0.5, 0.1); },
      [&] { sequencer.reinitialise(Sample::at_rest(Eigen::Vector2d::Ones())); },
      [&] { sequencer.hand_over(); },
      [&] { sequencer.append(sequence); },
      [&] { sequencer.replace(sequence); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const unsigned last = sequencer.changes();
    changes[i]();
    EXPECT_GT(sequencer.changes(), last) << i;
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

// Two changes of tau; times by hand from x = exp(−αt/τ) and φ = t/τ.
TEST(Switch, AtAPhaseOrAfterCyclesFollowsChangesOfTau) {
  const auto handed_over = [](Kind kind, const Switch& until, const Entry& entry) {
    Sequence sequence;
    sequence.then(slow(kind)).until(until);
    if (kind == Kind::rhythmic) sequence.enter(entry);
    sequence.then(slow(Kind::discrete));
    Sequencer sequencer(sequence, Join::dmp2a, Sample::at_rest(slow(kind).start_position));
    const double tau = slow(kind).tau;
    for (int k = 0; k < 10000 && sequencer.joins() < 2; ++k) {
      const bool changes = k == 100 || k == 300;
      EXPECT_TRUE(!changes || sequencer.set_tau(k == 100 ? 2.0 * tau : 0.5 * tau));
      sequencer.step(1e-3);
    }
    return sequencer.joins() == 2 ? sequencer.join(1).time : INFINITY;
  };
  // 0.3 s in which 0.2 τ go by, then twice as fast.
  const auto at = [](double taus) { return 0.3 + (taus - 0.2) / 2.0; };
  EXPECT_NEAR(handed_over(Kind::discrete, at_phase(0.5), {}), at(0.5 * std::log(2.0)), 1e-12);
  EXPECT_NEAR(handed_over(Kind::discrete, before_end(0.1), {}), at(1.0) - 0.1, 1e-12);
  EXPECT_NEAR(handed_over(Kind::discrete, after(0.7), {}), 0.7, 1e-12);
  EXPECT_NEAR(handed_over(Kind::rhythmic, after_cycles(1.5), {}), at(1.5), 1e-12);
  EXPECT_NEAR(handed_over(Kind::rhythmic, after_cycles(1.5), from_phase(2.0)), at(1.5), 1e-12);
  EXPECT_NEAR(handed_over(Kind::rhythmic, after_cycles(1.5), least_correction()), at(1.5), 1e-12);
  EXPECT_NEAR(handed_over(Kind::rhythmic, at_phase(M_PI), {}), at(0.5), 1e-12);
  EXPECT_NEAR(handed_over(Kind::rhythmic, at_phase(M_PI), from_phase(1.5 * M_PI)), at(0.75), 1e-12);
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
