// What a sequencer can be told on the way: with every method, in any state.

#include <array>

#include <gmock/gmock.h>
#include <malloc.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/sequencer.hpp>

namespace seam {
namespace {

const std::array<JoinSettings, 6> all_settings{Join::dmp2,
                                               JoinSettings(Join::dmp2a),
                                               JoinSettings(Join::dmp2a, WeightChange::first),
                                               JoinSettings(Join::dmp2a, WeightChange::strongest),
                                               Join::dmp3,
                                               Join::dmp2j};

std::string name(const JoinSettings& join) {
  const char* const changes[] = {"smallest", "first", "strongest"};
  return std::string(to_string(join.method)) + ", " + changes[static_cast<int>(join.change)];
}

Primitive primitive(Kind kind, unsigned seed = 50) {
  std::mt19937_64 random(seed);
  Primitive made = test::random_primitive(random, 2, kind == Kind::discrete ? 10 : 20, kind);
  made.tau = kind == Kind::discrete ? 1.0 : 0.5 / M_PI;  // a period of 1 s
  return made;
}

Sequencer started(const Sequence& sequence, const JoinSettings& join) {
  return {sequence, join, Sample::at_rest(sequence.steps().front().primitive.start_position)};
}

Sequencer alone(Kind kind, const JoinSettings& join) {
  return started(Sequence().then(primitive(kind)).until(on_call()), join);
}

void play(Sequencer& sequencer, double seconds) {
  for (long k = std::lround(seconds / 1e-3); k > 0; --k) sequencer.step(1e-3);
}

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

// Derivatives up to the acceleration are what they were.
void expect_same_motion(const Sample& before, const Sample& after, const std::string& place) {
  EXPECT_LT(distance(after.position, before.position), 1e-13) << place;
  EXPECT_LT(distance(after.velocity, before.velocity), 1e-13) << place;
  EXPECT_LT(distance(after.acceleration, before.acceleration), 1e-10) << place;
}

constexpr int begun = 140;  // [ms] when the start has died away

// Nor does the acceleration step right afterwards, when it goes on with the jerk.
void expect_smooth(const Sample& before, Sequencer sequencer, const std::string& place) {
  expect_same_motion(before, sequencer.sample(), place);
  const Eigen::VectorXd after = before.acceleration + 1e-7 * sequencer.state().jerk;
  sequencer.step(1e-7);
  EXPECT_LT(distance(sequencer.sample().acceleration, after), 1e-5) << place;
}

// Slower, faster in the midst of it, to a pause and on.
void move_rate(Sequencer& sequencer, int k) {
  if (k == 150) sequencer.set_rate(0.4, 0.2);
  if (k == 260) sequencer.set_rate(1.5, 0.15);
  if (k == 500) sequencer.set_rate(0.0, 0.2);
  if (k == 750) sequencer.set_rate(1.0, 0.2);
}

bool rate_has_corner(int k) {
  constexpr int brake = 296;  // its fall from 0.4 is at an end
  for (const int corner : {150, 260, brake, 410, 500, 700, 750, 950})
    if (std::abs(k - corner) <= 2) return true;
  return false;
}

// By finite differences of fourth order, away from where the rate's third derivative steps.
TEST(State, HasTheJerkInRealTimeAlsoWhileTheRateMoves) {
  constexpr double h = 1e-3;
  for (const Kind kind : {Kind::discrete, Kind::rhythmic})
    for (const JoinSettings& join : all_settings) {
      Sequencer sequencer = alone(kind, join);
      std::vector<Sample> path{sequencer.state()};
      for (int k = 0; k < 1100; ++k) {
        move_rate(sequencer, k);
        sequencer.step(h);
        path.push_back(sequencer.state());
        EXPECT_EQ(path.back().acceleration, sequencer.sample().acceleration);
      }
      double worst = 0.0;
      double largest = 0.0;
      for (std::size_t k = begun; k + 2 < path.size(); ++k) {
        if (rate_has_corner(static_cast<int>(k))) continue;
        const Eigen::VectorXd expected =
            (8.0 * (path[k + 1].acceleration - path[k - 1].acceleration) -
             (path[k + 2].acceleration - path[k - 2].acceleration)) /
            (12.0 * h);
        worst = std::max(worst, distance(path[k].jerk, expected));
        largest = std::max(largest, expected.cwiseAbs().maxCoeff());
      }
      EXPECT_LT(worst / largest, 1e-5) << name(join);
      EXPECT_GT(largest, 10.0);
    }
}

// What a step in jerk would leave stays as it is when ticks are halved.
TEST(Rate, ChangesWithoutAStepInJerkWithEveryMethod) {
  const auto largest_change = [](Kind kind, const JoinSettings& join, int ticks_in_1ms) {
    Sequencer sequencer = alone(kind, join);
    Eigen::VectorXd before = sequencer.state().jerk;
    double largest = 0.0;
    for (int k = 0; k < 1100 * ticks_in_1ms; ++k) {
      if (k % ticks_in_1ms == 0) move_rate(sequencer, k / ticks_in_1ms);
      EXPECT_LT(distance(sequencer.state().jerk, before), 1e-9 * (1.0 + before.norm()));
      sequencer.step(1e-3 / ticks_in_1ms);
      if (k > begun * ticks_in_1ms)
        largest = std::max(largest, distance(sequencer.state().jerk, before));
      before = sequencer.state().jerk;
    }
    return largest;
  };
  for (const Kind kind : {Kind::discrete, Kind::rhythmic})
    for (const JoinSettings& join : all_settings)
      EXPECT_GT(largest_change(kind, join, 1) / largest_change(kind, join, 2), 1.9) << name(join);
}

TEST(State, HasNoJerkWhileTheStartIsHeld) {
  Sequence sequence;
  sequence.start_after(0.1).then(primitive(Kind::discrete));
  Sequencer sequencer = started(sequence, Join::dmp3);
  sequencer.step(0.05);
  EXPECT_TRUE(sequencer.state().jerk.isZero(0.0));
  Sample jerky = sequencer.sample();
  jerky.jerk(0) = 1.0;
  EXPECT_EQ(test::refusal([&] { Sequencer(sequence, Join::dmp3, jerky); }),
            "sequencer: start moves, must be at rest where the first primitive is delayed");
}

// At the start of a primitive, in its midst, where its phase has faded, and while a rhythm settles.
TEST(Reinitialise, ContinuesAsTheMethodSays) {
  for (const Kind kind : {Kind::discrete, Kind::rhythmic})
    for (const JoinSettings& join : all_settings)
      for (const double time : {0.01, 0.4, 2.3}) {
        const std::string place = name(join) + ", at " + std::to_string(time) + " s";
        Sequencer sequencer = alone(kind, join);
        play(sequencer, time);
        if (time > 2.0) sequencer.hand_over();
        sequencer.set_rate(0.5, 0.1);
        play(sequencer, 0.05);
        Sample measured = sequencer.state();
        measured.position += Eigen::Vector2d(0.05, -0.02);
        measured.velocity += Eigen::Vector2d(-0.2, 0.1);
        measured.acceleration += Eigen::Vector2d(1.0, 2.0);
        measured.jerk += Eigen::Vector2d(-10.0, 20.0);
        ASSERT_TRUE(sequencer.reinitialise(measured));
        EXPECT_EQ(sequencer.rate(), 1.0);
        const Sample& now = sequencer.state();
        EXPECT_LT(distance(now.position, measured.position), 1e-13) << place;
        EXPECT_LT(distance(now.velocity, measured.velocity), 1e-13) << place;
        EXPECT_TRUE(join.method == Join::dmp2 ||
                    distance(now.acceleration, measured.acceleration) < 1e-10)
            << place;
        EXPECT_TRUE(join.method != Join::dmp2j || distance(now.jerk, measured.jerk) < 1e-8)
            << place;
        sequencer.hand_over();
        play(sequencer, 6.0);
        EXPECT_LT(distance(sequencer.sample().position, primitive(kind).goal), 1e-3) << place;
      }
}

// Eq. 1 with r = g, by hand: dmp2 forgets the acceleration.
TEST(Reinitialise, StepsInAccelerationWithDmp2AsItsEquationSays) {
  Sequencer sequencer = alone(Kind::discrete, Join::dmp2);
  play(sequencer, 0.4);
  const Sample before = sequencer.sample();
  Sample measured = before;
  measured.position(0) += 0.05;
  measured.velocity(1) += 0.3;
  ASSERT_TRUE(sequencer.reinitialise(measured));
  const Primitive shown = primitive(Kind::discrete);
  const Eigen::Vector2d step(-shown.gains.K * 0.05 / (shown.tau * shown.tau),
                             -shown.gains.D * 0.3 / shown.tau);
  EXPECT_LT(distance(sequencer.sample().acceleration - before.acceleration, step), 1e-11);
}

TEST(Change, OfADiscretePrimitiveKeepsTheMotionAndArrives) {
  const Eigen::VectorXd goal = primitive(Kind::discrete).goal + Eigen::Vector2d(0.1, -0.05);
  for (const JoinSettings& join : all_settings)
    for (const double time : {0.01, 0.2, 0.7, 1.6}) {
      if (join.method == Join::dmp2) continue;
      const std::string place = name(join) + ", at " + std::to_string(time) + " s";
      Sequencer sequencer = alone(Kind::discrete, join);
      play(sequencer, time);
      const Sample before = sequencer.sample();
      ASSERT_TRUE(sequencer.set_goal(goal));
      expect_smooth(before, sequencer, place + ", goal");
      ASSERT_TRUE(sequencer.set_tau(1.3));
      expect_smooth(before, sequencer, place + ", tau");
      EXPECT_FALSE(sequencer.set_amplitude(1.2));
      play(sequencer, 8.0);
      EXPECT_LT(distance(sequencer.sample().position, goal), 1e-3) << place;
    }
}

// What remains of a change is the new goal, amplitude and tau alone: y − g is proportional to A and hangs on φ.
TEST(Change, OfARhythmKeepsTheMotionAndLeadsToTheChangedRhythm) {
  const Primitive shown = primitive(Kind::rhythmic);
  const Eigen::VectorXd goal = shown.goal + Eigen::Vector2d(0.1, -0.05);
  for (const JoinSettings& join : all_settings)
    for (const double time : {0.01, 0.2, 0.7, 1.6}) {
      if (join.method == Join::dmp2) continue;
      const std::string place = name(join) + ", at " + std::to_string(time) + " s";
      Sequencer sequencer = alone(Kind::rhythmic, join);
      play(sequencer, time);
      const Sample before = sequencer.sample();
      ASSERT_TRUE(sequencer.set_goal(goal));
      expect_smooth(before, sequencer, place + ", goal");
      ASSERT_TRUE(sequencer.set_amplitude(1.2));
      expect_smooth(before, sequencer, place + ", amplitude");
      ASSERT_TRUE(sequencer.set_tau(1.25 * shown.tau));
      expect_smooth(before, sequencer, place + ", tau");
      Sequencer plain = alone(Kind::rhythmic, join);
      play(plain, 8.0 + time);
      play(sequencer, 10.0);
      EXPECT_NEAR(sequencer.phase(), plain.phase(), 1e-9);
      // Within the phase, y depends on t/τ alone.
      EXPECT_LT(distance((sequencer.sample().position - goal) / 1.2,
                         plain.sample().position - shown.goal),
                1e-6)
          << place;
    }
}

// At half the rate a step in acceleration is a quarter: dmp2 shows it at once.
TEST(Change, IsSeenInRealTimeAtOnce) {
  const Sequence next = Sequence().then(primitive(Kind::discrete, 51));
  const auto slowed = [&](Kind kind) {
    Sequencer sequencer = alone(kind, Join::dmp2);
    sequencer.set_rate(0.5, 0.1);
    play(sequencer, 0.4);
    return sequencer;
  };
  const auto shown = [](const Sequencer& sequencer) -> Eigen::VectorXd {
    return sequencer.join(sequencer.joins() - 1).acceleration_after / 4.0;
  };
  for (const Kind kind : {Kind::discrete, Kind::rhythmic}) {
    Sequencer sequencer = slowed(kind);
    sequencer.append(next);
    sequencer.hand_over();
    EXPECT_LT(distance(sequencer.sample().acceleration, shown(sequencer)), 1e-12);
    sequencer.hand_over();
    play(sequencer, 0.1);
    sequencer.append(next);
    EXPECT_LT(distance(sequencer.sample().acceleration, shown(sequencer)), 1e-12);
  }
  Sequencer settling = slowed(Kind::rhythmic);
  settling.hand_over();
  EXPECT_LT(distance(settling.sample().acceleration, shown(settling)), 1e-12);

  const Primitive moved = primitive(Kind::discrete);
  Sequencer sequencer = slowed(Kind::discrete);
  const Sample before = sequencer.sample();
  ASSERT_TRUE(sequencer.set_goal(moved.goal + Eigen::Vector2d(0.1, -0.1)));
  const double step = moved.gains.K / (moved.tau * moved.tau) * 0.1 / 4.0;
  EXPECT_LT(
      distance(sequencer.sample().acceleration - before.acceleration, Eigen::Vector2d(step, -step)),
      1e-11);
}

enum class In { waiting, running, turning, paused, settling, finished };
constexpr std::array<In, 6> all_states{In::waiting, In::running,  In::turning,
                                       In::paused,  In::settling, In::finished};
const char* const state_names[] = {"waiting", "running", "turning", "paused", "settling", "done"};

bool over(In state) {
  return state == In::settling || state == In::finished;
}
bool rhythmic(In state) {
  return state == In::turning || state == In::settling;
}

// Where nothing is over, another primitive is still to come.
Sequencer in(In state, Join method) {
  const Kind kind = rhythmic(state) ? Kind::rhythmic : Kind::discrete;
  Sequence sequence;
  sequence.start_after(state == In::waiting ? 0.5 : 0.0);
  sequence.then(primitive(kind)).until(after(0.8));
  if (!over(state)) sequence.then(primitive(Kind::discrete, 51));
  Sequencer sequencer = started(sequence, method);
  play(sequencer, 0.3);
  if (state == In::paused) sequencer.set_rate(0.0, 0.1);
  play(sequencer, over(state) ? 0.7 : 0.15);
  return sequencer;
}

void finish(Sequencer& sequencer) {
  if (sequencer.rate() == 0.0) sequencer.set_rate(1.0, 0.1);
  Sample before = sequencer.sample();
  for (int k = 0; k < 10000; ++k) {
    sequencer.step(1e-3);
    const Sample& now = sequencer.sample();
    ASSERT_LT(distance(now.position, before.position + 1e-3 * before.velocity), 1e-3) << k;
    before = now;
  }
  EXPECT_TRUE(sequencer.finished());
}

// Nothing that a sequencer is told, in whatever state, is a step in position, velocity or acceleration.
TEST(AnyState, IsLeftWithoutAStep) {
  const Sequence next = Sequence().then(primitive(Kind::discrete, 52));
  using Act = std::function<void(Sequencer&)>;
  const std::array<Act, 9> acts{
      [](Sequencer& s) { s.hand_over(); },
      [](Sequencer& s) { s.set_goal(Eigen::Vector2d(0.3, 0.1)); },
      [](Sequencer& s) { s.set_tau(0.6); }, [](Sequencer& s) { s.set_amplitude(0.7); },
      [](Sequencer& s) { s.set_rate(0.5, 0.2); }, [&](Sequencer& s) { s.append(next); },
      [&](Sequencer& s) { s.replace(next); }, [](Sequencer& s) { s.clear(); },
      // At a pause real time stands still, and a state in it is one at rest.
      [](Sequencer& s) { s.reinitialise(Sample(s.state())); }};
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j})
    for (const In state : all_states)
      for (std::size_t i = 0; i < acts.size(); ++i) {
        SCOPED_TRACE(std::string(to_string(method)) + ", " + state_names[static_cast<int>(state)] +
                     ", act " + std::to_string(i));
        Sequencer sequencer = in(state, method);
        const Sample before = sequencer.sample();
        acts[i](sequencer);
        expect_same_motion(before, sequencer.sample(), "");
        finish(sequencer);
      }
}

TEST(AnyState, HandsOverToWhatComesNext) {
  for (const In state : all_states) {
    SCOPED_TRACE(state_names[static_cast<int>(state)]);
    Sequencer sequencer = in(state, Join::dmp2a);
    const int running = sequencer.running();
    EXPECT_EQ(running, state == In::waiting ? -1 : 0);
    EXPECT_EQ(sequencer.finished(), over(state));
    EXPECT_EQ(sequencer.hand_over(), !over(state));
    EXPECT_EQ(sequencer.running(), over(state) ? 0 : running + 1);
    const double joined = state == In::settling ? 0.8 : state == In::finished ? 0.0 : 0.45;
    EXPECT_NEAR(sequencer.join(sequencer.joins() - 1).time, joined, 1e-12);
    finish(sequencer);
  }
}

TEST(AnyState, TakesTheChangesThatItCanFollow) {
  const Eigen::VectorXd goal = Eigen::Vector2d(0.3, 0.1);
  for (const In state : all_states) {
    SCOPED_TRACE(state_names[static_cast<int>(state)]);
    const bool has_begun = state != In::waiting;
    Sequencer sequencer = in(state, Join::dmp3);
    EXPECT_EQ(sequencer.set_goal(goal), has_begun);
    EXPECT_EQ(sequencer.set_tau(0.5), has_begun);
    EXPECT_EQ(sequencer.set_amplitude(1.2), state == In::turning);
    EXPECT_TRUE(sequencer.reinitialise(Sample(sequencer.state())));
    EXPECT_FALSE(sequencer.set_goal(Eigen::Vector3d::Zero()));
    EXPECT_FALSE(sequencer.set_goal(Eigen::Vector2d(0.0, NAN)));
    EXPECT_FALSE(sequencer.set_tau(0.0));
    EXPECT_FALSE(sequencer.set_amplitude(NAN));
    EXPECT_FALSE(sequencer.set_rate(-1.0, 0.1));
    EXPECT_FALSE(sequencer.reinitialise(Sample(3)));
    EXPECT_TRUE(sequencer.set_rate(0.5, 0.1));
    sequencer.clear();
    finish(sequencer);
    const Eigen::VectorXd end = has_begun ? goal : primitive(Kind::discrete).start_position;
    EXPECT_LT(distance(sequencer.sample().position, end), 1e-3);
  }
}

TEST(AnyState, PlaysWhatIsAppendedOrPutInPlaceOfTheRest) {
  const Primitive last = primitive(Kind::discrete, 52);
  const Sequence next = Sequence().then(last);
  for (const In state : all_states)
    for (const bool replaced : {false, true}) {
      SCOPED_TRACE(std::string(state_names[static_cast<int>(state)]) +
                   (replaced ? ", replaced" : ", appended"));
      Sequencer sequencer = in(state, Join::dmp3);
      replaced ? sequencer.replace(next) : sequencer.append(next);
      EXPECT_FALSE(sequencer.finished());
      EXPECT_EQ(sequencer.running(), state == In::waiting ? -1 : over(state) ? 1 : 0);
      finish(sequencer);
      const int dropped = !replaced || over(state) ? 0 : state == In::waiting ? 2 : 1;
      EXPECT_EQ(sequencer.running(), (over(state) ? 1 : 2) - dropped);
      EXPECT_LT(distance(sequencer.sample().position, last.goal), 1e-3);
    }
}

// A primitive of any kind, speed and place.
Primitive any_primitive(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Kind kind = uniform(random) < 0.5 ? Kind::discrete : Kind::rhythmic;
  Primitive made = test::random_primitive(random, 2, kind == Kind::discrete ? 10 : 20, kind);
  made.tau *= 0.5 + uniform(random);
  return made;
}

Sequence any_sequence(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Sequence sequence;
  if (random() % 8 == 0) sequence.start_after(0.3 * uniform(random));
  for (auto left = 1 + random() % 3; left > 0; --left) {
    sequence.then(any_primitive(random));
    if (random() % 4 > 0) sequence.until(after(0.02 + uniform(random)));
  }
  return sequence;
}

double any_time(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  return std::pow(10.0, 4.0 * uniform(random) - 4.0);
}

// Tells a sequencer anything but to step, as its app may at any time. @return  what
std::string tell(Sequencer& sequencer, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto positive = [&] { return 1.0 + uniform(random); };
  switch (random() % 9) {
    case 0:
      sequencer.set_goal(Eigen::Vector2d(uniform(random), uniform(random)));
      return "goal";
    case 1:
      sequencer.set_tau((0.3 + positive()) * (random() % 2 ? 1.0 : 0.15));
      return "tau";
    case 2:
      sequencer.set_amplitude(positive());
      return "amplitude";
    case 3:
      sequencer.set_rate(random() % 4 == 0 ? 0.0 : positive(), any_time(random));
      return "rate";
    case 4:
      sequencer.hand_over();
      return "hand over";
    case 5:
      sequencer.append(any_sequence(random));
      return "append";
    case 6:
      sequencer.replace(any_sequence(random));
      return "replace";
    case 7:
      sequencer.clear();
      return "clear";
    default:
      sequencer.reinitialise(Sample(sequencer.state()));
      return "reinitialise";
  }
}

// Whatever it is told, whenever: position, velocity and (but for dmp2) acceleration are what they were.
TEST(AnyCalls, LeaveTheMotionWithoutAStep) {
  constexpr int calls = 4000;
  for (const JoinSettings& join : all_settings)
    for (unsigned seed = 60; seed < 65; ++seed) {
      std::mt19937_64 random(seed);
      Sequencer sequencer = started(any_sequence(random), join);
      for (int i = 0; i < calls; ++i) {
        for (auto steps = random() % 20; steps > 0; --steps)
          sequencer.step(any_time(random) / 20.0);
        const Sample before = sequencer.state();
        double scale = 1.0;
        for (const auto* part :
             {&before.position, &before.velocity, &before.acceleration, &before.jerk})
          scale = std::max(scale, part->cwiseAbs().maxCoeff());
        const std::string told = tell(sequencer, random);
        const Sample& after = sequencer.sample();
        SCOPED_TRACE(name(join) + ", seed " + std::to_string(seed) + ", call " + std::to_string(i) +
                     ": " + told);
        ASSERT_LT(distance(after.position, before.position), 1e-12 * scale);
        ASSERT_LT(distance(after.velocity, before.velocity), 1e-12 * scale);
        if (join.method == Join::dmp2) continue;
        ASSERT_LT(distance(after.acceleration, before.acceleration), 1e-10 * scale);
      }
    }
}

TEST(Pause, HoldsWhateverIsChangedMeanwhile) {
  Sequencer sequencer = in(In::paused, Join::dmp2a);
  const Eigen::VectorXd held = sequencer.sample().position;
  sequencer.set_goal(Eigen::Vector2d(0.3, 0.1));
  sequencer.set_tau(0.7);
  sequencer.hand_over();
  play(sequencer, 1.0);
  EXPECT_LT(distance(sequencer.sample().position, held), 1e-13);
  EXPECT_TRUE(sequencer.sample().velocity.isZero(0.0));
  EXPECT_TRUE(sequencer.state().jerk.isZero(0.0));
  EXPECT_EQ(sequencer.running(), 1);
  EXPECT_FALSE(sequencer.finished());
  EXPECT_NEAR(sequencer.time(), 1.45, 1e-9);
}

std::size_t bytes_in_use() {
  return mallinfo2().uordblks;
}

// An app that appends one primitive whenever few are left, as it would for days.
TEST(LongRun, KeepsItsMemoryAndGoesOnCounting) {
  constexpr int items = 100000;
  Sequence one;
  one.then(primitive(Kind::rhythmic)).until(after(0.05));
  Sequencer sequencer = started(one, Join::dmp3);
  sequencer.append(one);
  std::size_t early = 0;
  for (int i = 0; i < items; ++i) {
    const AllocationGuard guard;
    for (int k = 0; k < 5; ++k) sequencer.step(1e-2);
    ASSERT_EQ(guard.allocations(), 0) << i;
    ASSERT_EQ(sequencer.running(), i + 1);
    sequencer.append(one);
    if (i == 1000) early = bytes_in_use();
  }
  EXPECT_LT(bytes_in_use(), early + 20000);
  EXPECT_EQ(sequencer.joins(), items + 1);
  EXPECT_LE(sequencer.joins() - sequencer.first_join(), Sequencer::kept_joins);
  EXPECT_GE(sequencer.joins() - sequencer.first_join(), Sequencer::kept_joins - 1);
  for (int i = sequencer.first_join(); i < sequencer.joins(); ++i) {
    EXPECT_EQ(sequencer.join(i).primitive, i);
    EXPECT_NEAR(sequencer.join(i).time, 0.05 * i, 1e-6);
  }
  finish(sequencer);
  EXPECT_EQ(sequencer.running(), items + 1);
}

// The motion that settles takes longer than tau, and stays within a primitive's bounds.
TEST(LongRun, PlaysTheSlowestRhythm) {
  Primitive slowest = primitive(Kind::rhythmic);
  slowest.tau = tau_bounds.largest;
  Sequencer sequencer = started(Sequence().then(slowest).until(on_call()), Join::dmp2a);
  play(sequencer, 0.1);
  EXPECT_TRUE(sequencer.hand_over());
  EXPECT_TRUE(sequencer.finished());
  EXPECT_TRUE(sequencer.sample().position.allFinite());
}

// Dropping and replacing what is to come leaves what has been played to be told.
TEST(LongRun, ReplacesForEver) {
  Sequence two;
  two.then(primitive(Kind::discrete)).until(after(0.03));
  two.then(primitive(Kind::rhythmic)).until(after(0.03));
  Sequencer sequencer = started(two, Join::dmp2a);
  std::size_t early = 0;
  for (int i = 0; i < 10000; ++i) {
    for (int k = 0; k < 1 + i % 7; ++k) sequencer.step(1e-2);
    if (i % 11 == 0) sequencer.clear();
    if (i % 5 == 0) sequencer.hand_over();
    sequencer.replace(two);
    if (i == 1000) early = bytes_in_use();
    ASSERT_LE(sequencer.first_join(), sequencer.joins());
  }
  EXPECT_LT(bytes_in_use(), early + 20000);
  EXPECT_GT(sequencer.running(), 5000);
  EXPECT_EQ(sequencer.join(sequencer.joins() - 1).primitive, sequencer.running());
}

}  // namespace
}  // namespace seam
