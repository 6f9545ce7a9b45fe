#include <cmath>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/joins.hpp"
#include "tests/ode.hpp"
#include "tests/support.hpp"
#include <seam/sequencer.hpp>

namespace seam {
namespace {

using test::largest;
using test::Ode;
using Real = Ode::Real;

// Smooth in everything it depends on: a gust that turns the motion aside, drags, and mixes the coordinates.
template <typename Number>
auto gust(const Eigen::Matrix<Number, Eigen::Dynamic, 1>& y,
          const Eigen::Matrix<Number, Eigen::Dynamic, 1>& yd, Number t) {
  Eigen::Matrix<Number, Eigen::Dynamic, 1> c(y.size());
  const Number bump = Number(8) * std::exp(-y.squaredNorm());
  for (Eigen::Index d = 0; d < y.size(); ++d) {
    const Eigen::Index next = (d + 1) % y.size();
    c(d) = bump * std::sin(Number(3) * t + Number(d)) - Number(2) * yd(next) * std::cos(y(d)) +
           Number(5) * std::sin(y(next));
  }
  return c;
}

class Gust : public Coupling {
 public:
  explicit Gust(int D) : D_(D) {}
  void add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
           Eigen::VectorXd& ydd) const noexcept override {
    const double bump = 8.0 * std::exp(-y.squaredNorm());
    for (Eigen::Index d = 0; d < D_; ++d) {
      const Eigen::Index next = (d + 1) % D_;
      ydd(d) += bump * std::sin(3.0 * t + static_cast<double>(d)) -
                2.0 * yd(next) * std::cos(y(d)) + 5.0 * std::sin(y(next));
    }
  }

 private:
  Eigen::Index D_;
};

Ode blown(const Primitive& primitive, Real time) {
  Ode ode(primitive);
  ode.coupling = gust<Real>;
  ode.set_time(time);
  return ode;
}

Ode::Matrix motion_of(const Sample& at) {
  Ode::Matrix motion(at.position.size(), 4);
  motion << at.position.cast<Real>(), at.velocity.cast<Real>(), at.acceleration.cast<Real>(),
      at.jerk.cast<Real>();
  return motion;
}

// Largest difference from an independent solution, a share of the coordinate's range, over 2 s of a discrete, a rhythmic
// and a discrete primitive, joined while the gust blows; with a rhythm of 2 s. One of 1 s has up to 1.7e-9 at 1 ms.
double error_of_the_whole(const JoinSettings& method, double dt, int ode_steps) {
  constexpr int D = 3;
  std::mt19937_64 random(61);
  Primitive parts[] = {test::random_primitive(random, D),
                       test::random_primitive(random, D, 20, Kind::rhythmic),
                       test::random_primitive(random, D, 12)};
  parts[1].tau = 1.0 / M_PI;
  Sequence sequence;
  sequence.then(parts[0]).until(after(0.6));
  sequence.then(parts[1]).enter(from_phase(2.0)).until(after(0.8)).then(parts[2]);
  Sample start = Sample::at_rest(parts[0].start_position);
  start.velocity = parts[0].start_velocity;
  start.acceleration = parts[0].start_acceleration;
  Sequencer sequencer(sequence, method, start);
  sequencer.add_coupling(std::make_shared<Gust>(D));
  Ode ode = blown(parts[0], 0.0L);
  ode.join(motion_of(start), 1.0L, method);
  Eigen::Array3d wrong = Eigen::Array3d::Zero();
  Eigen::Array3d low = start.position;
  Eigen::Array3d high = low;
  const int ticks = static_cast<int>(std::lround(2.0 / dt));
  for (int k = 1; k <= ticks; ++k) {
    sequencer.step(dt);
    ode.advance(Real(dt), ode_steps);
    const Eigen::Array3d y = ode.motion().col(0).cast<double>();
    low = low.min(y);
    high = high.max(y);
    wrong = wrong.max((sequencer.sample().position.array() - y).abs());
    if (k == ticks * 3 / 10 || k == ticks * 7 / 10) {
      const Primitive& next = parts[k == ticks * 3 / 10 ? 1 : 2];
      const Ode::Matrix before = ode.motion();
      ode = blown(next, ode.time());
      ode.join(before, next.kind == Kind::rhythmic ? 2.0L : 1.0L, method);
    }
  }
  EXPECT_EQ(sequencer.joins(), 3);
  return (wrong / (high - low)).maxCoeff();
}

TEST(Coupling, AgreesWithAnIndependentSolutionOfTheWholeSequence) {
  for (const JoinSettings& method : test::all_methods()) {
    EXPECT_LT(error_of_the_whole(method, 1e-3, 10), 1e-9) << test::word(method) << ", seed 61";
  }
}

TEST(Coupling, IsOfFourthOrderInTheTick) {
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
    const double coarse = error_of_the_whole(method, 4e-3, 40);
    const double fine = error_of_the_whole(method, 2e-3, 20);
    EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.4) << to_string(method) << ", seed 61";
  }
}

// Joins, and every change on the way, while the gust blows.
TEST(Coupling, AccelerationContinuesThroughJoinsAndChanges) {
  std::mt19937_64 random(62);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Kind kind : {Kind::discrete, Kind::rhythmic})
    for (int i = 0; i < 50; ++i)
      for (const JoinSettings& method : test::continuous_methods) {
        const Primitive first = test::random_primitive(random, 3);
        const Primitive second = test::random_primitive(random, 3, 20, kind);
        Sequence sequence;
        sequence.then(first).until(on_call()).then(second).until(on_call());
        Sequencer sequencer(sequence, method, Sample::at_rest(first.start_position));
        sequencer.add_coupling(std::make_shared<Gust>(3));
        const auto play = [&](double longest) {
          for (double left = longest * uniform(random); left > 0.0; left -= 1e-3)
            sequencer.step(1e-3);
        };
        double peak = 1.0, peak_jerk = 1.0;
        const auto expect_continuous = [&](const char* what, const std::function<bool()>& change) {
          const Sample before = sequencer.state();
          ASSERT_TRUE(change());
          const Sample& after = sequencer.state();
          peak = std::max(peak, largest(before.acceleration));
          peak_jerk = std::max(peak_jerk, largest(before.jerk));
          EXPECT_LE(largest(after.position - before.position), 1e-13);
          EXPECT_LE(largest(after.velocity - before.velocity), 1e-12);
          EXPECT_LE(largest(after.acceleration - before.acceleration), 1e-9 * peak)
              << what << ", " << test::word(method) << ", seed 62, case " << i;
          if (method.method == Join::dmp2j) {
            EXPECT_LE(largest(after.jerk - before.jerk), 1e-9 * peak_jerk)
                << what << ", seed 62, case " << i;
          }
        };
        play(0.5);
        expect_continuous("join", [&] { return sequencer.hand_over(); });
        play(1.5);
        expect_continuous("goal",
                          [&] { return sequencer.set_goal(sequencer.goal().array() + 0.3); });
        play(0.3);
        expect_continuous("tau", [&] { return sequencer.set_tau(0.7 * second.tau); });
        play(0.3);
        if (kind == Kind::rhythmic)
          expect_continuous("amplitude", [&] { return sequencer.set_amplitude(1.3); });
        play(0.3);
        expect_continuous("end", [&] { return sequencer.hand_over(); });
        expect_continuous("rate", [&] { return sequencer.set_rate(0.5, 0.2); });
      }
}

// Of what is smooth the jerk is what the acceleration's difference gives, and what a solution in long double has.
TEST(Coupling, IsInTheJerk) {
  std::mt19937_64 random(63);
  for (const Kind kind : {Kind::discrete, Kind::rhythmic}) {
    const Primitive primitive = test::random_primitive(random, 3, 12, kind);
    Execution execution(primitive);
    execution.couple(std::make_shared<Gust>(3), 0.7);
    Ode ode = blown(primitive, 0.7L);
    for (int k = 0; k < 4000; ++k) {
      execution.step(1e-4);
      ode.advance(1e-4L, 5);
    }
    const Eigen::MatrixXd motion = ode.motion().cast<double>();
    const Sample& state = execution.state();
    EXPECT_LT(largest(state.acceleration - motion.col(2)), 1e-9 * largest(motion.col(2)));
    EXPECT_LT(largest(state.jerk - motion.col(3)), 1e-8 * largest(motion.col(3)));
  }
}

Sequence two(unsigned seed) {
  std::mt19937_64 random(seed);
  Sequence sequence;
  sequence.then(test::random_primitive(random, 3)).until(after(0.3));
  sequence.then(test::random_primitive(random, 3, 12, Kind::rhythmic)).until(after(0.5));
  return sequence;
}

// What is added steps ÿ by what it is then, and takes it back.
TEST(Coupling, ActsFromWhenItIsAddedUntilItIsRemoved) {
  const Sequence sequence = two(64);
  Sequencer plain(sequence, Join::dmp3, sequence.start_state());
  Sequencer blown = plain;
  plain.step(0.1);
  blown.step(0.1);
  const auto gusts = std::make_shared<Gust>(3);
  const Sample before = blown.sample();
  Eigen::VectorXd acts = Eigen::VectorXd::Zero(3);
  gusts->add(before.position, before.velocity, 0.1, acts);
  blown.add_coupling(gusts);
  blown.add_coupling(gusts);
  EXPECT_LT(largest(blown.sample().acceleration - before.acceleration - 2.0 * acts), 1e-12);
  EXPECT_EQ(blown.couplings().size(), 2u);
  EXPECT_TRUE(blown.remove_coupling(gusts));
  EXPECT_LT(largest(blown.sample().acceleration - before.acceleration - acts), 1e-12);
  const Sequencer copy = blown;
  blown.clear_couplings();
  EXPECT_FALSE(blown.remove_coupling(gusts));
  EXPECT_LT(largest(blown.sample().acceleration - before.acceleration), 1e-12);
  EXPECT_EQ(copy.couplings().size(), 1u);
  EXPECT_LT(largest(copy.sample().acceleration - before.acceleration - acts), 1e-12);
  plain.step(0.5);
  blown.step(0.5);
  EXPECT_LT(largest(blown.sample().position - plain.sample().position), 1e-9);
  EXPECT_THAT(test::refusal([&] { blown.add_coupling(nullptr); }), "sequencer: a coupling is null");
}

// A start that is joined to already is joined to again: it keeps its acceleration.
TEST(Coupling, BeforeTheFirstStepLeavesNoStepInAcceleration) {
  const Sequence sequence = two(68);
  for (const JoinSettings& method : test::continuous_methods) {
    Sequencer sequencer(sequence, method, sequence.start_state());
    sequencer.add_coupling(std::make_shared<Gust>(3));
    EXPECT_LT(largest(sequencer.sample().acceleration), 1e-11) << test::word(method);
    EXPECT_LT(largest(sequencer.join(0).acceleration_after), 1e-11) << test::word(method);
    sequencer.clear_couplings();
    EXPECT_LT(largest(sequencer.sample().acceleration), 1e-11) << test::word(method);
  }
}

class Clock : public Coupling {
 public:
  void add(const Eigen::VectorXd&, const Eigen::VectorXd&, double t,
           Eigen::VectorXd& ydd) const noexcept override {
    ydd(0) += t;
  }
};

// The time that a coupling is told goes on over joins, is slowed with the rate, and is there for what is appended.
TEST(Coupling, IsToldTheMotionsOwnTime) {
  Sequence sequence = two(65);
  sequence.start_after(0.05);
  Sequencer sequencer(sequence, Join::dmp2, sequence.start_state());
  Sequencer plain = sequencer;
  sequencer.add_coupling(std::make_shared<Clock>());
  EXPECT_TRUE(sequencer.sample().acceleration.isZero(0.0));
  sequencer.append(two(65));
  plain.append(two(65));
  ASSERT_TRUE(sequencer.set_rate(0.5, 0.2));
  for (int k = 0; k < 4000; ++k) {
    sequencer.step(1e-3);
    if (sequencer.running() < 0) {
      EXPECT_TRUE(sequencer.state().acceleration.isZero(0.0));
    }
    if (k % 100 == 50 && sequencer.running() >= 0) {
      // Without the clock, ÿ is less by the time: by removing it.
      Sequencer without = sequencer;
      without.clear_couplings();
      const double rate = sequencer.rate();
      const double acts = sequencer.sample().acceleration(0) - without.sample().acceleration(0);
      EXPECT_NEAR(acts, rate * rate * sequencer.motion_time(), 1e-9) << k;
    }
  }
  EXPECT_EQ(sequencer.running(), 3);
  EXPECT_NEAR(sequencer.motion_time(), 0.5 * (4.0 - 0.2) + 0.2 * 0.75, 1e-9);
  EXPECT_NEAR(sequencer.time(), 4.0, 1e-9);
}

TEST(Coupling, AllocatesNothingAfterItIsAdded) {
  const Sequence sequence = two(66);
  for (const JoinSettings& method : test::all_methods()) {
    Sequencer sequencer(sequence, method, sequence.start_state());
    sequencer.add_coupling(std::make_shared<Gust>(3));
    sequencer.add_coupling(std::make_shared<Gust>(3));
    const Eigen::VectorXd goal = sequencer.goal().array() + 0.1;
    const AllocationGuard guard;
    for (int k = 0; k < 2000; ++k) {
      sequencer.step(1e-3);
      sequencer.state();
      if (k == 150 || k == 400) sequencer.set_goal(goal);
      if (k == 200) sequencer.set_tau(0.9);
    }
    EXPECT_EQ(guard.allocations(), 0) << test::word(method);
    EXPECT_TRUE(sequencer.finished());
  }
}

// One that adds nothing changes nothing.
TEST(Coupling, OfNothingLeavesTheMotionAsItIs) {
  class Nothing : public Coupling {
    void add(const Eigen::VectorXd&, const Eigen::VectorXd&, double,
             Eigen::VectorXd&) const noexcept override {}
  };
  const Sequence sequence = two(67);
  for (const JoinSettings& method : test::all_methods()) {
    Sequencer plain(sequence, method, sequence.start_state());
    Sequencer coupled = plain;
    coupled.add_coupling(std::make_shared<Nothing>());
    for (int k = 0; k < 1500; ++k) {
      plain.step(1e-3);
      coupled.step(1e-3);
      ASSERT_LT(largest(plain.state().position - coupled.state().position), 1e-13)
          << test::word(method) << ", tick " << k;
      ASSERT_LT(largest(plain.sample().acceleration - coupled.sample().acceleration), 1e-10);
      ASSERT_LT(largest(plain.sample().jerk - coupled.sample().jerk), 1e-8);
    }
  }
}

}  // namespace
}  // namespace seam
