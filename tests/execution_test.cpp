#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/joins.hpp"
#include "tests/ode.hpp"
#include "tests/support.hpp"
#include <seam/execution.hpp>

namespace seam {
namespace {

constexpr double ode_step = 1e-4;

// An execution and an independent solution of the same sequence. Each hands over its own state, so that the errors of the
// whole sequence add up.
class SideBySide {
 public:
  SideBySide(const Primitive& first, double dt, double fine = ode_step)
      : dt_(dt), fine_(fine), execution_(first), ode_(first), worst_(first.dimensions()) {
    worst_.setZero();
    low_ = high_ = first.start_position;
  }

  void join(const Primitive& next, double phase, const JoinSettings& with) {
    const Sample at = execution_.state();
    const test::Ode::Matrix motion = ode_.motion();
    execution_ = Execution(next);
    execution_.reinitialise(at, phase, with);
    ode_ = test::Ode(next);
    ode_.join(motion, phase, with);
  }
  void start(const JoinSettings& with) {
    Sample at(execution_.dimensions());
    at.position = ode_.primitive.start_position;
    at.acceleration.setConstant(2.0);
    at.jerk.setConstant(-20.0);
    test::Ode::Matrix motion(at.position.size(), 4);
    motion << at.position.cast<test::Ode::Real>(), at.velocity.cast<test::Ode::Real>(),
        at.acceleration.cast<test::Ode::Real>(), at.jerk.cast<test::Ode::Real>();
    const double phase = execution_.kind() == Kind::rhythmic ? 0.7 : 1.0;
    execution_.reinitialise(at, phase, with);
    ode_.join(motion, phase, with);
  }
  template <class Action>
  void change(const Action& action) {
    action(execution_);
    action(ode_);
  }
  void move_goal(double by) {
    const Eigen::VectorXd goal = execution_.goal().array() + by;
    change([&](auto& either) { either.set_goal(goal); });
  }
  void change_tau(double factor) {
    const double tau = factor * execution_.tau();
    change([&](auto& either) { either.set_tau(tau); });
  }
  void change_amplitude(double amplitude) {
    if (execution_.kind() == Kind::rhythmic)
      change([&](auto& either) { either.set_amplitude(amplitude); });
  }
  void play(double seconds) {
    for (long i = std::lround(seconds / dt_); i > 0; --i) {
      execution_.step(dt_);
      ode_.advance(dt_, static_cast<int>(std::lround(dt_ / fine_)));
      const Eigen::VectorXd& y = execution_.sample().position;
      worst_ = worst_.cwiseMax((y - ode_.motion().col(0).cast<double>()).cwiseAbs());
      low_ = low_.cwiseMin(y);
      high_ = high_.cwiseMax(y);
      if (ode_.added().cwiseAbs().maxCoeff() > 1e-6) added_ = true;
    }
  }

  /// Of the worst coordinate, relative to its own range.
  double error() const { return worst_.cwiseQuotient(high_ - low_).maxCoeff(); }
  /// There was forcing that is added to what the weights give.
  bool added() const { return added_; }
  const Execution& execution() const { return execution_; }
  const test::Ode& ode() const { return ode_; }

 private:
  double dt_, fine_;
  Execution execution_;
  test::Ode ode_;
  Eigen::VectorXd worst_, low_, high_;
  bool added_ = false;
};

using Joined = std::tuple<Kind, Kind, JoinSettings>;

std::string name(const testing::TestParamInfo<Joined>& of) {
  return test::word(std::get<0>(of.param)) + "To" + test::word(std::get<1>(of.param)) +
         test::word(std::get<2>(of.param));
}

const auto everything = testing::Combine(testing::Values(Kind::discrete, Kind::rhythmic),
                                         testing::Values(Kind::discrete, Kind::rhythmic),
                                         testing::ValuesIn(test::all_methods()));

Primitive any_primitive(std::mt19937_64& random, Kind kind) {
  Primitive primitive = test::random_primitive(random, 3, kind == Kind::rhythmic ? 20 : 10, kind);
  if (kind == Kind::rhythmic) primitive.tau *= 2.0;
  return primitive;
}

// A start, a join and every change on the way, early and, where a discrete phase has faded, late.
SideBySide sequence(unsigned seed, const Joined& of, double dt, double fine = ode_step) {
  const auto& [from, to, with] = of;
  std::mt19937_64 random(seed);
  SideBySide both(any_primitive(random, from), dt, fine);
  const Primitive next = any_primitive(random, to);
  both.start(with);
  both.play(0.32);
  both.move_goal(0.2);
  both.play(0.16);
  both.join(next, to == Kind::rhythmic ? 2.0 + seed : 1.0, with);
  both.play(0.08);
  both.change_amplitude(1.4);
  both.play(0.16);
  both.move_goal(-0.3);
  both.play(0.16);
  both.change_tau(0.8);
  both.play(0.24);
  both.change_tau(1.5);
  both.move_goal(0.1);
  both.play(1.6);
  both.move_goal(0.2);
  both.play(0.08);
  both.change_tau(0.7);
  both.change_amplitude(0.6);
  both.play(0.4);
  return both;
}

class SequenceOf : public testing::TestWithParam<Joined> {};

TEST_P(SequenceOf, AgreesWithAnIndependentSolution) {
  for (unsigned seed = 1; seed <= 2; ++seed)
    EXPECT_LT(sequence(seed, GetParam(), 1e-3).error(), 1e-9) << "seed " << seed;
}

TEST_P(SequenceOf, HasAnErrorOfFourthOrderInTheStep) {
  const double coarse = sequence(4, GetParam(), 8e-3).error();
  const double fine = sequence(4, GetParam(), 4e-3).error();
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.4) << "seed 4";
}

INSTANTIATE_TEST_SUITE_P(, SequenceOf, everything, name);

TEST(Execution, IsStableForAnyStep) {
  std::mt19937_64 random(7);
  const Primitive primitive = test::random_primitive(random, 3);
  for (const double dt : {0.05, 0.5, 5.0, 500.0}) {
    Execution execution(primitive);
    for (double t = 0.0; t < 60.0 * primitive.tau; t += dt) execution.step(dt);
    EXPECT_LT((execution.sample().position - primitive.goal).cwiseAbs().maxCoeff(), 1e-3) << dt;
  }
}

TEST(Execution, VelocityAndAccelerationAreDerivativesOfThePosition) {
  std::mt19937_64 random(8);
  Execution execution(test::random_primitive(random, 1));
  const double h = 1e-4;
  for (int i = 0; i < 50; ++i) {
    const Sample a = execution.sample();
    execution.step(h);
    const Sample b = execution.sample();
    execution.step(h);
    const Sample c = execution.sample();
    EXPECT_NEAR(b.velocity(0), (c.position(0) - a.position(0)) / (2.0 * h), 1e-5);
    EXPECT_NEAR(b.acceleration(0), (c.velocity(0) - a.velocity(0)) / (2.0 * h), 1e-3);
  }
}

TEST(Execution, StepsAndReinitialisesWithoutAllocating) {
  std::mt19937_64 random(9);
  const Primitive primitive = test::random_primitive(random, 7, 20, Kind::rhythmic);
  Execution execution(primitive);
  const Sample at = Sample::at_rest(primitive.start_position);
  const Eigen::VectorXd goal = primitive.goal;
  const AllocationGuard guard;
  for (const Join method : all_joins) {
    execution.reinitialise(at, 1.0, method);
    for (int i = 0; i < 10; ++i) execution.step(i < 5 ? 1e-3 : 2e-3);
    execution.set_goal(goal);
    execution.set_tau(0.3);
    execution.set_amplitude(1.2);
    execution.step(1e-3);
    execution.least_correction_phase(at);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
