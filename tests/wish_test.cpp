#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/joins.hpp"
#include "tests/ode.hpp"
#include "tests/wiggle.hpp"
#include <seam/conditions.hpp>
#include <seam/execution.hpp>
#include <seam/learn.hpp>
#include <seam/sequencer.hpp>

namespace seam {
namespace {

using test::largest;
using test::refusal;

constexpr double dt = 1e-3;
constexpr unsigned seed = 21;

Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<Eigen::Index>(values.size()));
}

// A state on the way of some predecessor.
Sample moving(std::mt19937_64& random, const Primitive& primitive) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Sample at(primitive.dimensions());
  at.position = primitive.start_position;
  for (int d = 0; d < primitive.dimensions(); ++d) {
    at.velocity(d) = 0.5 * uniform(random);
    at.acceleration(d) = 3.0 * uniform(random);
    at.jerk(d) = 10.0 * uniform(random);
  }
  return at;
}

// Ticks, and then what is left until a time.
void advance(Execution& execution, double time) {
  const int ticks = static_cast<int>(time / dt);
  for (int k = 0; k < ticks; ++k) execution.step(dt);
  execution.step(time - ticks * dt);
}

double range(const Primitive& primitive) {
  return std::max(1.0, largest(primitive.goal - primitive.start_position));
}

class OfEveryMethod : public testing::TestWithParam<JoinSettings> {};

INSTANTIATE_TEST_SUITE_P(Wish, OfEveryMethod, testing::ValuesIn(test::all_methods()),
                         [](const auto& method) { return test::word(method.param); });

TEST_P(OfEveryMethod, PassesAtItsMomentAlsoBetweenTicksAndArrivesAndStays) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(i));
    const Primitive primitive = test::random_primitive(random, 3, 12 + i % 9);
    const double moment = (0.45 + 0.005 * i) * primitive.tau + 0.4e-3;
    const Eigen::VectorXd through = vector({primitive.goal(0) + 0.2, NAN, -0.3});
    Execution execution(primitive, {pass(through, at(moment)), arrive()});
    const Sample from = moving(random, primitive);
    execution.reinitialise(from, 1.0, GetParam());
    ASSERT_TRUE(execution.wishes_hold());
    const double before = largest(execution.sample().acceleration - from.acceleration);
    if (GetParam().method != Join::dmp2) {
      EXPECT_LE(before, 1e-9 * largest(execution.price().acceleration));
    }
    if (GetParam().method == Join::dmp2j) {
      EXPECT_LE(largest(execution.state().jerk - from.jerk),
                1e-9 * largest(execution.price().acceleration) / primitive.tau);
    }
    advance(execution, moment);
    EXPECT_NEAR(execution.sample().position(0), through(0), 1e-9 * range(primitive));
    EXPECT_NEAR(execution.sample().position(2), through(2), 1e-9 * range(primitive));
    advance(execution, primitive.tau - moment);
    for (int later = 0; later < 3; ++later) {
      EXPECT_LE(largest(execution.sample().position - primitive.goal), 1e-9 * range(primitive));
      EXPECT_LE(largest(execution.sample().velocity), 1e-8 * range(primitive));
      EXPECT_LE(largest(execution.sample().acceleration), 1e-6 * range(primitive));
      advance(execution, 0.4);
    }
  }
}

// Without wishes the weights solve the join alone, so that dmp2 is plain; the step in acceleration that it has stays what it was.
TEST(Wish, LeavesTheStepOfDmp2AsItIs) {
  std::mt19937_64 random(seed);
  const Primitive primitive = test::random_primitive(random, 2, 15);
  const Sample from = moving(random, primitive);
  Execution plain(primitive);
  Execution wishing(primitive, {arrive()});
  plain.reinitialise(from, 1.0, Join::dmp2);
  wishing.reinitialise(from, 1.0, Join::dmp2);
  EXPECT_LE(largest(plain.sample().acceleration - wishing.sample().acceleration), 1e-10);
}

// The smallest change of the weights, found from responses that long double's Runge-Kutta gives, kernel by kernel.
class WishOde : public test::Ode {
 public:
  using test::Ode::Ode;

  // Changes the weights so that rows of conditions hold, in the smallest way.
  struct Condition {
    Real time;
    int order;
    Vector value;  // D
  };
  void wish(const std::vector<Condition>& conditions) {
    const auto M = weights.rows();
    const auto n = static_cast<Eigen::Index>(conditions.size()) + 1;
    Matrix rows(n, M), right(n, goal.size());
    const Vector psi = kernels(phase());
    rows.row(0) = psi.transpose() / psi.norm();  // the forcing of this moment stays
    right.row(0).setZero();
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const auto& [time, order, value] = conditions[i];
      const Matrix without = later(time);
      for (Eigen::Index j = 0; j < M; ++j) {
        WishOde one = *this;
        one.weights.row(j).array() += 1.0L;
        rows(static_cast<Eigen::Index>(i) + 1, j) = (one.later(time) - without)(0, order);
      }
      right.row(static_cast<Eigen::Index>(i) + 1) = (value - without.col(order)).transpose();
    }
    const Matrix gram = rows * rows.transpose();
    weights += rows.transpose() * gram.fullPivHouseholderQr().solve(right);
  }
  Matrix later(Real time) const {
    Ode copy = *this;
    copy.advance(time, 3000);
    return copy.motion();
  }
};

TEST_P(OfEveryMethod, AgreesWithAnOdeForWhichResponsesWereFoundKernelByKernel) {
  std::mt19937_64 random(seed + 1);
  const Primitive primitive = test::random_primitive(random, 2, 14);
  const Sample from = moving(random, primitive);
  const double moment = 0.55 * primitive.tau;
  Execution execution(primitive,
                      {hit(vector({0.4, -0.2}), vector({0.3, 0.8}), at(moment)), arrive()});
  execution.reinitialise(from, 1.0, GetParam());

  WishOde ode(primitive);
  test::Ode::Matrix start(2, 4);
  start << from.position.cast<long double>(), from.velocity.cast<long double>(),
      from.acceleration.cast<long double>(), from.jerk.cast<long double>();
  ode.join(start, 1.0L, GetParam());
  const test::Ode::Vector nothing = test::Ode::Vector::Zero(2);
  std::vector<WishOde::Condition> conditions{{moment, 0, vector({0.4, -0.2}).cast<long double>()},
                                             {moment, 1, vector({0.3, 0.8}).cast<long double>()},
                                             {primitive.tau, 0, primitive.goal.cast<long double>()},
                                             {primitive.tau, 1, nothing},
                                             {primitive.tau, 2, nothing}};
  if (GetParam().method == Join::dmp2j) return;  // has one row more, of the rate
  ode.wish(conditions);
  for (int k = 1; k <= 10; ++k) {
    advance(execution, primitive.tau / 10.0 - 1e-12);
    ode.advance(primitive.tau / 10.0L, 600);
    const test::Ode::Matrix motion = ode.motion();
    for (int d = 0; d < 2; ++d) {
      EXPECT_NEAR(execution.sample().position(d), static_cast<double>(motion(d, 0)),
                  1e-9 * range(primitive));
      EXPECT_NEAR(execution.sample().velocity(d), static_cast<double>(motion(d, 1)), 1e-8);
    }
  }
}

// A point that is seen better and better, while goal and tau change as well.
TEST_P(OfEveryMethod, CanBeMovedOnTheWayWithoutAStep) {
  std::mt19937_64 random(seed + 2);
  std::normal_distribution<double> noise(0.0, 0.01);
  const Primitive primitive = test::random_primitive(random, 3, 15);
  Execution execution(primitive, {arrive(at(primitive.tau))});
  execution.reinitialise(moving(random, primitive), 1.0, GetParam());
  const double moment = 0.7 * primitive.tau;
  Eigen::VectorXd point;
  Eigen::VectorXd goal = primitive.goal;
  if (GetParam().method == Join::dmp2) GTEST_SKIP() << "steps when its goal changes";
  double jump = 0.0, peak = 0.0, time = 0.0;
  const auto change = [&](const std::function<bool()>& act) {
    const Eigen::VectorXd before = execution.sample().acceleration;
    EXPECT_TRUE(act()) << "at " << time;
    jump = std::max(jump, largest(execution.sample().acceleration - before));
  };
  const double every = primitive.tau / 36.0;
  for (int i = 0; i < 17; ++i) {
    advance(execution, every);
    time += every;
    point = vector({0.5 + noise(random), -0.2 + noise(random), NAN});
    change([&] { return execution.set_wish(1, pass(point, at(moment))); });
    if (i == 5) change([&] { return execution.set_goal(goal = goal.array() + 0.3); });
    if (i == 9) change([&] { return execution.set_tau(1.05 * primitive.tau); });
    peak = std::max(peak, largest(execution.sample().acceleration));
  }
  EXPECT_LE(jump, 1e-9 * peak);
  advance(execution, moment - time);
  EXPECT_LE(largest((execution.sample().position - point).head<2>()), 1e-9 * range(primitive));
  advance(execution, primitive.tau - moment);
  EXPECT_LE(largest(execution.sample().position - goal), 1e-9 * range(primitive));
  EXPECT_TRUE(execution.set_goal(primitive.goal)) << "it has arrived, and follows its goal";
  advance(execution, 3.0 * primitive.tau);
  EXPECT_LE(largest(execution.sample().position - primitive.goal), 1e-6);
}

TEST_P(OfEveryMethod, PassesWithinTheCycleThatARhythmEnters) {
  std::mt19937_64 random(seed + 3);
  for (const double entry : {0.0, 2.5, 40.0}) {
    const Primitive primitive = test::random_primitive(random, 2, 20, Kind::rhythmic);
    for (const double share : {0.3, 0.6, 0.95}) {
      const double moment = share * 2.0 * M_PI * primitive.tau;
      Execution execution(primitive, {pass(vector({0.3, NAN}), at(moment))});
      Execution plain(primitive);
      const Sample from = moving(random, primitive);
      execution.reinitialise(from, entry, GetParam());
      plain.reinitialise(from, entry, GetParam());
      ASSERT_TRUE(execution.wishes_hold());
      if (GetParam().method != Join::dmp2) {
        EXPECT_LE(largest(execution.sample().acceleration - from.acceleration),
                  1e-9 * largest(execution.price().acceleration));
      }
      advance(execution, 0.5 * moment);
      ASSERT_TRUE(execution.set_wish(0, pass(vector({0.35, NAN}), at(moment))));
      ASSERT_TRUE(execution.set_amplitude(1.1));
      advance(execution, moment - 0.5 * moment);
      EXPECT_NEAR(execution.sample().position(0), 0.35, 1e-9);
      plain.set_amplitude(1.1);
      for (Execution* one : {&execution, &plain}) advance(*one, 12.0 * M_PI * primitive.tau);
      advance(plain, moment);
      EXPECT_NEAR(execution.sample().position(0), plain.sample().position(0), 1e-6)
          << "the change has faded";
    }
  }
}

TEST(Wish, OfARhythmMadeWhileTheJoinFadesDoesNotStep) {
  std::mt19937_64 random(seed + 4);
  for (const JoinSettings& method : test::continuous_methods) {
    const Primitive primitive = test::random_primitive(random, 2, 20, Kind::rhythmic);
    Execution execution(primitive);
    execution.reinitialise(moving(random, primitive), 0.0, method);
    advance(execution, 1.5 * primitive.tau);
    const Sample before = execution.state();
    const double moment = 4.0 * primitive.tau;
    ASSERT_TRUE(execution.set_wish(0, pass(vector({NAN, 0.1}), at(moment))));
    EXPECT_LE(largest(execution.state().acceleration - before.acceleration),
              1e-9 * largest(before.acceleration));
    if (method.method == Join::dmp2j) {
      EXPECT_LE(largest(execution.state().jerk - before.jerk), 1e-9 * largest(before.jerk));
    }
    advance(execution, 2.5 * primitive.tau);
    EXPECT_NEAR(execution.sample().position(1), 0.1, 1e-9);
  }
}

TEST(Wish, OfARhythmMadeAfterTheJoinHasFadedDoesNotStep) {
  std::mt19937_64 random(seed + 14);
  for (const JoinSettings& method : test::continuous_methods) {
    const Primitive primitive = test::random_primitive(random, 2, 20, Kind::rhythmic);
    Execution execution(primitive);
    execution.reinitialise(moving(random, primitive), 0.0, method);
    advance(execution, 4.5 * primitive.tau);
    const Eigen::VectorXd before = execution.sample().acceleration;
    ASSERT_TRUE(execution.set_wish(0, pass(vector({NAN, 0.1}), at(5.9 * primitive.tau))));
    execution.step(1e-9);
    EXPECT_LE(largest(execution.sample().acceleration - before), 1e-5 * largest(before));
  }
}

TEST(Wish, IsRefusedWhereItIsNearerThanRounding) {
  std::mt19937_64 random(seed + 15);
  for (const JoinSettings& method : test::all_methods())
    for (const double tau : {0.3, 1.0, 1000.0}) {
      Primitive primitive = test::random_primitive(random, 2, 20);
      primitive.tau = tau;
      Execution execution(primitive);
      execution.reinitialise(moving(random, primitive), 1.0, method);
      advance(execution, 0.1);
      for (const double ahead : {1.1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4})
        EXPECT_FALSE(execution.set_wish(
            0, pass(execution.sample().position.array() + 0.1, at(0.1 + ahead))));
    }
}

TEST(Wish, ThatATauWouldPutIntoThePastHoldsTheTau) {
  std::mt19937_64 random(seed + 16);
  Primitive primitive = test::random_primitive(random, 2, 20);
  primitive.tau = 1.0;
  Execution execution(primitive, {arrive(before_end(0.3))});
  execution.reinitialise(moving(random, primitive), 1.0, Join::dmp2a);
  advance(execution, 0.3);
  EXPECT_FALSE(execution.set_tau(0.3));
  EXPECT_EQ(execution.tau(), 1.0);
  advance(execution, 0.4);
  EXPECT_LE(largest(execution.sample().position - primitive.goal), 1e-9 * range(primitive));
}

TEST(Wish, ThatIsLostLeavesTheOthers) {
  std::mt19937_64 random(seed + 17);
  const Primitive primitive = test::random_primitive(random, 2, 20);
  const double moment = 0.5 * primitive.tau;
  Execution execution(primitive, {pass(vector({0.3, 0.1}), at(moment)), arrive()});
  execution.reinitialise(moving(random, primitive), 1.0, Join::dmp2a);
  EXPECT_TRUE(execution.price().possible);
  advance(execution, moment - 0.005);
  Sample pushed = execution.state();
  pushed.position.array() += 0.01;
  execution.resume(pushed);
  EXPECT_FALSE(execution.wishes_hold());
  EXPECT_FALSE(execution.price().possible);
  advance(execution, primitive.tau - moment + 0.005);
  EXPECT_LE(largest(execution.sample().position - primitive.goal), 1e-9 * range(primitive));
}

TEST(Wish, IsNotSaidToHoldWhereACouplingActsAtItsMoment) {
  class Wind : public Coupling {
   public:
    void add(const Eigen::VectorXd&, const Eigen::VectorXd&, double t,
             Eigen::VectorXd& ydd) const noexcept override {
      if (t > 0.4 && t < 0.8) ydd(0) += 30.0 * std::pow(std::sin((t - 0.4) / 0.4 * M_PI), 4);
    }
  };
  for (const double moment : {0.3, 0.6}) {
    Primitive primitive = learn(test::minimum_jerk());
    Execution execution(primitive, {pass(vector({0.4}), at(moment))});
    execution.couple(std::make_shared<Wind>(), 0.0);
    execution.reinitialise(Sample::at_rest(Eigen::VectorXd::Zero(1)), 1.0, Join::dmp2a);
    for (int k = 0; k < 1000; ++k) execution.step(dt);
    EXPECT_EQ(execution.wishes_hold(), moment < 0.4) << moment;
  }
}

TEST(Wish, IsRefusedInWordsWhereItCannotBe) {
  std::mt19937_64 random(seed);
  const Primitive reach = test::random_primitive(random, 2, 10);
  const Primitive coarse = test::random_primitive(random, 2, 3);
  const Primitive rhythm = test::random_primitive(random, 2, 12, Kind::rhythmic);
  const double tau = reach.tau;
  const auto why = [](const Primitive& primitive, const std::vector<Wish>& wishes,
                      Join join = Join::dmp2a) {
    return refusal([&] {
      Execution execution(primitive, wishes);
      execution.require_possible(execution.basis().start_phase(), join);
    });
  };
  const Eigen::VectorXd here = vector({0.1, 0.2});
  using testing::HasSubstr;
  using testing::StartsWith;
  EXPECT_THAT(why(reach, {pass(here, at(0.5 * tau)), pass(here, at(0.001))}),
              StartsWith("wish 2: asks too much of the kernels"));
  EXPECT_THAT(why(reach, {pass(here, at(0.5 * tau)), pass(2.0 * here, at(0.5 * tau))}),
              StartsWith("wish 2: asks too much"));
  EXPECT_THAT(why(coarse, {pass(here, at(0.5 * coarse.tau)), arrive()}),
              StartsWith("wish 2: asks too much"));
  EXPECT_THAT(why(reach, {pass(here, at(-0.5))}), HasSubstr("must be > 0"));
  EXPECT_THAT(why(reach, {pass(here, at(9.0 * tau))}), HasSubstr("lost their hold"));
  EXPECT_THAT(why(reach, {arrive(), pass(here, at(1.2 * tau))}), HasSubstr("after the arrival"));
  EXPECT_THAT(why(reach, {arrive(at(0.6 * tau)), arrive(at(0.9 * tau))}),
              StartsWith("wish 2: arrives for a second time"));
  Wish elsewhere = arrive();
  elsewhere.position = here;
  EXPECT_THAT(why(reach, {elsewhere}), HasSubstr("no values of its own"));
  EXPECT_THAT(why(rhythm, {arrive(at(0.5))}), HasSubstr("rhythmic"));
  EXPECT_THAT(why(rhythm, {pass(here, at(7.0 * rhythm.tau))}), HasSubstr("after the cycle"));
  EXPECT_THAT(why(reach, {pass(here, near_goal(0.1))}), HasSubstr("moment"));
  EXPECT_THAT(why(reach, {pass(here, at(NAN))}), HasSubstr("moment"));
  EXPECT_THAT(why(reach, {pass(vector({INFINITY, 0.0}), at(0.5))}), HasSubstr("finite"));
  EXPECT_THAT(why(reach, {pass(vector({NAN, NAN}), at(0.5))}), HasSubstr("free"));
  EXPECT_THAT(why(reach, {pass(vector({1.0}), at(0.5))}), HasSubstr("per coordinate"));
}

TEST(Wish, IsRefusedWhereKernelsOrGainsAreTooSharpToTell) {
  std::mt19937_64 random(seed);
  Primitive narrow = test::random_primitive(random, 2, 10);
  narrow.kernels.widths.setConstant(1e-9);
  Primitive stiff = test::random_primitive(random, 2, 10);
  stiff.gains = Gains{1.0, 1e6, 1.0};
  for (const Primitive& primitive : {narrow, stiff}) {
    Execution execution(primitive);
    const Wish wish = pass(vector({0.1, NAN}), at(0.5 * primitive.tau));
    EXPECT_FALSE(execution.set_wish(0, wish));
    EXPECT_FALSE(execution.price_of(0, wish).possible);
    execution.step(dt);
    EXPECT_TRUE(execution.sample().position.allFinite());
  }
}

// A quick decay, gains from soft to stiff, kernels that overlap much or little.
TEST(Wish, IsMetWithOtherGainsKernelsAndDecays) {
  std::mt19937_64 random(seed + 13);
  for (const double alpha : {0.5, 2.0, 4.0})
    for (const Gains& gains :
         {Gains::critical(30.0), Gains::paper(), Gains{900.0, 90.0, 30.0}, Gains{400.0, 8.0, 20.0}})
      for (const double width : {0.4, 1.0, 1.5}) {
        Primitive primitive = test::random_primitive(random, 2, 15);
        primitive.alpha = alpha;
        primitive.gains = gains;
        primitive.kernels = Kernels::even_in_time(15, width, alpha);
        const double moment = 0.5 * primitive.tau + 0.3e-3;
        Execution execution(primitive, {pass(vector({0.1, NAN}), at(moment)), arrive()});
        execution.reinitialise(moving(random, primitive), 1.0, Join::dmp2a);
        SCOPED_TRACE("alpha " + std::to_string(alpha) + ", K " + std::to_string(gains.K) +
                     ", width " + std::to_string(width));
        ASSERT_TRUE(execution.wishes_hold());
        advance(execution, moment);
        EXPECT_NEAR(execution.sample().position(0), 0.1, 2e-9 * range(primitive));
        advance(execution, primitive.tau - moment);
        EXPECT_LE(largest(execution.sample().position - primitive.goal), 2e-9 * range(primitive));
      }
}

// What is refused on the way changes nothing, to the bit.
TEST_P(OfEveryMethod, ThatIsRefusedOnTheWayChangesNothing) {
  std::mt19937_64 random(seed + 5);
  for (const Kind kind : {Kind::discrete, Kind::rhythmic}) {
    const Primitive primitive = test::random_primitive(random, 2, 15, kind);
    const double cycle = kind == Kind::discrete ? primitive.tau : 2.0 * M_PI * primitive.tau;
    const Wish wish = pass(vector({0.2, 0.1}), at(0.7 * cycle));
    Execution execution(primitive, {wish});
    execution.reinitialise(moving(random, primitive), execution.basis().start_phase(), GetParam());
    advance(execution, 0.68 * cycle);
    Execution twin = execution;
    EXPECT_FALSE(twin.set_wish(0, pass(vector({0.3, 0.1}), at(0.69 * cycle))));
    EXPECT_FALSE(twin.set_wish(1, pass(vector({0.3, 0.1}), at(0.7 * cycle))));
    EXPECT_FALSE(twin.set_wish(2, wish));
    EXPECT_FALSE(twin.set_wish(-1, wish));
    EXPECT_FALSE(twin.set_wish(0, pass(vector({0.3, 0.1}), at(0.5 * cycle))));
    EXPECT_FALSE(twin.set_goal(primitive.goal.array() + 1.0)) << "two hundredths before a wish";
    EXPECT_FALSE(twin.set_tau(1.01 * primitive.tau));
    EXPECT_FALSE(twin.price_of(0, pass(vector({0.3, 0.1}), at(0.69 * cycle))).possible);
    EXPECT_EQ(twin.goal(), execution.goal());
    EXPECT_EQ(twin.tau(), execution.tau());
    for (Execution* one : {&execution, &twin}) advance(*one, 0.02 * cycle);
    EXPECT_LE(largest(twin.sample().position - execution.sample().position), 1e-14);
    EXPECT_NEAR(twin.sample().position(0), 0.2, 1e-9);
  }
}

TEST_P(OfEveryMethod, TellsItsPriceBeforehand) {
  std::mt19937_64 random(seed + 6);
  for (int i = 0; i < 20; ++i) {
    const Primitive primitive = test::random_primitive(random, 2, 15);
    const Sample from = moving(random, primitive);
    Execution plain(primitive);
    plain.reinitialise(from, 1.0, GetParam());
    const Wish wish = pass(vector({0.5, NAN}), at(0.6 * primitive.tau));
    const Price price = plain.price_of(0, wish);
    ASSERT_TRUE(price.possible);
    Execution wishing = plain;
    ASSERT_TRUE(wishing.set_wish(0, wish));
    EXPECT_TRUE(plain.price().deviation.isZero(0.0)) << "it was entered without wishes";
    Eigen::Array2d deviation(0.0, 0.0);
    Eigen::Array2d acceleration = wishing.sample().acceleration.array().abs();
    for (double t = 0.0; t < primitive.tau; t += dt) {
      plain.step(dt);
      wishing.step(dt);
      const auto away = (wishing.sample().position - plain.sample().position).array().abs();
      deviation = deviation.max(away);
      acceleration = acceleration.max(wishing.sample().acceleration.array().abs());
    }
    EXPECT_NEAR(price.deviation(0), deviation(0), 0.02 * deviation(0));
    EXPECT_LE(deviation(1), 1e-12);
    EXPECT_LE(price.deviation(1), 1e-12);
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(price.acceleration(d), acceleration(d), 0.1 * acceleration(d));
  }
}

// Pushes while the first coordinate is in a region, smoothly.
class Push : public Coupling {
 public:
  void add(const Eigen::VectorXd& y, const Eigen::VectorXd&, double,
           Eigen::VectorXd& ydd) const noexcept override {
    const double inside = 1.0 - std::pow((y(0) - 0.2) / 0.15, 2);
    if (inside > 0.0) ydd(1) += 20.0 * inside * inside * inside;
  }
};

TEST(Wish, IsMetAgainOnceACouplingHasLetGo) {
  LearnSettings settings;
  settings.kernels = 20;
  Primitive primitive = learn(test::minimum_jerk(), settings);
  const Primitive one = primitive;
  primitive.coordinates = {"y0", "y1"};
  primitive.weights = one.weights.replicate(1, 2);
  primitive.goal = Eigen::Vector2d(1.0, 1.0);
  primitive.start_position = primitive.start_velocity = primitive.start_acceleration =
      Eigen::Vector2d::Zero();
  for (const Join method : all_joins) {
    Execution execution(primitive, {pass(vector({0.8, 0.85}), at(0.75)), arrive()});
    execution.couple(std::make_shared<Push>(), 0.0);
    execution.reinitialise(Sample::at_rest(Eigen::Vector2d::Zero()), 1.0, method);
    double jump = 0.0, peak = 0.0, apart = 0.0;
    Eigen::VectorXd last = execution.sample().acceleration;
    for (int k = 0; k < 750; ++k) {
      execution.step(dt);
      const Eigen::VectorXd now = execution.sample().acceleration;
      jump = std::max(jump, largest(now - last));
      peak = std::max(peak, largest(now));
      apart = std::max(apart,
                       std::abs(execution.sample().position(1) - execution.sample().position(0)));
      last = now;
    }
    SCOPED_TRACE(to_string(method));
    EXPECT_GT(apart, 0.05) << "the coupling pushes";
    EXPECT_LE(jump, 0.03 * peak) << "within a tick";
    EXPECT_LE(largest(execution.sample().position - vector({0.8, 0.85})), 1e-9);
    EXPECT_TRUE(execution.wishes_hold());
    advance(execution, 0.25);
    EXPECT_LE(largest(execution.sample().position - primitive.goal), 1e-9);
  }
}

TEST(Wish, ToLeaveWithAnAccelerationIsGranted) {
  std::mt19937_64 random(seed + 7);
  for (const JoinSettings& method : test::all_methods()) {
    const Primitive primitive = test::random_primitive(random, 2, 12);
    const Sample from = moving(random, primitive);
    Execution plain(primitive);
    Execution leaving(primitive, {arrive()}, vector({1.5, NAN}));
    plain.reinitialise(from, 1.0, method);
    leaving.reinitialise(from, 1.0, method);
    EXPECT_NEAR(leaving.sample().acceleration(0), 1.5, 1e-9) << test::word(method);
    EXPECT_NEAR(leaving.sample().acceleration(1), plain.sample().acceleration(1), 1e-9);
    advance(leaving, primitive.tau);
    EXPECT_LE(largest(leaving.sample().position - primitive.goal), 1e-9 * range(primitive));
  }
}

TEST(Wish, ToArriveWithoutSmoothnessLetsTheAccelerationDieOut) {
  std::mt19937_64 random(seed + 8);
  const Primitive primitive = test::random_primitive(random, 1, 12);
  Execution execution(primitive, {arrive(at_end(), false)});
  execution.reinitialise(moving(random, primitive), 1.0, Join::dmp2a);
  advance(execution, primitive.tau - 1e-9);
  const double before = execution.sample().acceleration(0);
  execution.step(2e-9);
  EXPECT_NEAR(execution.sample().position(0), primitive.goal(0), 1e-8);
  EXPECT_NEAR(execution.sample().velocity(0), 0.0, 1e-6);
  EXPECT_NEAR(execution.sample().acceleration(0), before, 1e-5 * std::abs(before));
  advance(execution, 2.0 * primitive.tau);
  EXPECT_NEAR(execution.sample().position(0), primitive.goal(0), 1e-9);
}

// The figures that were measured before this was written: a wiggle, M = 20 and 10, width 1, in 1.2 s, entered at 0.5 /s and −3 /s².
TEST(Wish, CostsWhatWasCalculatedBeforehand) {
  const auto deviation = [](int kernels, const std::vector<Wish>& wishes) {
    LearnSettings settings;
    settings.kernels = kernels;
    settings.width = 1.0;
    Primitive primitive = learn(test::wiggle(), settings);
    primitive.tau = 1.2;
    Sample from(1);
    from.velocity(0) = 0.5;
    from.acceleration(0) = -3.0;
    Execution plain(primitive), wishing(primitive, wishes);
    plain.reinitialise(from, 1.0, Join::dmp2);
    wishing.reinitialise(from, 1.0, Join::dmp2a);
    double most = 0.0;
    for (int k = 0; k < 1200; ++k) {
      most = std::max(most, std::abs(wishing.sample().position(0) - plain.sample().position(0)));
      plain.step(dt), wishing.step(dt);
    }
    return most;
  };
  EXPECT_NEAR(deviation(20, {}), 0.020, 0.001);
  EXPECT_NEAR(deviation(20, {arrive(at_end(), false)}), 0.020, 0.001);
  EXPECT_NEAR(deviation(20, {arrive()}), 0.020, 0.001);
  EXPECT_NEAR(deviation(10, {}), 0.029, 0.001);
}

TEST(Wish, IsMadeAndMovedWithoutAllocating) {
  std::mt19937_64 random(seed + 9);
  for (const Join method : all_joins) {
    const Primitive primitive = test::random_primitive(random, 7, 20);
    Sequence sequence;
    sequence.then(primitive).pass({{"y0", 0.3}}, at(0.5 * primitive.tau)).arrive();
    Sequencer sequencer(sequence, method, sequence.start_state());
    const Wish moved = pass(Eigen::VectorXd::Constant(7, 0.2), at(0.55 * primitive.tau));
    const Eigen::VectorXd goal = primitive.goal.array() + 0.1;
    const Wish another = pass(goal, at(0.8 * primitive.tau));
    const AllocationGuard guard;
    for (int k = 0; k < 3000; ++k) {
      if (k == 50) {
        EXPECT_TRUE(sequencer.price_of(0, moved).possible);
      }
      if (k == 50) {
        EXPECT_TRUE(sequencer.set_wish(0, moved));
      }
      if (k == 60) {
        EXPECT_TRUE(sequencer.set_goal(goal));
      }
      if (k == 70) {
        EXPECT_TRUE(sequencer.set_wish(2, another));
      }
      if (k == 80) sequencer.drop_wishes();
      sequencer.step(dt);
    }
    EXPECT_EQ(guard.allocations(), 0) << to_string(method);
  }
}

TEST(Conditions, GiveTheSmallestChangeThatMeetsThem) {
  std::srand(seed);
  for (int n = 1; n <= 6; ++n) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, 12) * 100.0;
    const Eigen::VectorXd b = Eigen::VectorXd::Random(n);
    Conditions conditions(12, 6);
    for (int i = 0; i < n; ++i) {
      ASSERT_TRUE(conditions.add(A.row(i).transpose(), 0.01));
      conditions.meet(i, b(i));
    }
    const Eigen::VectorXd change = conditions.change(0, n);
    const Eigen::VectorXd smallest = A.completeOrthogonalDecomposition().solve(b);
    EXPECT_LE((change - smallest).norm(), 1e-12);
    EXPECT_FALSE(conditions.add((A.row(0) + 1e-5 * A.row(n - 1)).transpose(), 0.01));
    EXPECT_FALSE(conditions.add(Eigen::VectorXd::Zero(12), 0.01));
  }
}

TEST(Sequence, KeepsWishesAndRefusesThoseThatCannotBe) {
  std::mt19937_64 random(seed);
  const Primitive reach = test::random_primitive(random, 2, 10);
  Sequence task;
  task.then(reach).pass({{"y1", 0.4}}, at(0.4 * reach.tau)).leave({{"y0", 2.0}}).arrive();
  ASSERT_EQ(task.steps()[0].wishes.size(), 2u);
  EXPECT_TRUE(std::isnan(task.steps()[0].wishes[0].position(0)));
  EXPECT_EQ(task.steps()[0].wishes[0].position(1), 0.4);
  EXPECT_EQ(task.steps()[0].leave(0), 2.0);
  using testing::HasSubstr;
  EXPECT_EQ(refusal([&] {
              task.pass({{"z", 0.4}}, at(0.5));
            }),
            "sequence: primitive 1: pass: \"z\" is not among its coordinates");
  EXPECT_THAT(refusal([&] { task.pass({{"y0", NAN}}, at(0.5)); }), HasSubstr("must be finite"));
  EXPECT_THAT(refusal([&] {
                task.pass({{"y0", 1.0}}, at(0.001));
              }),
              HasSubstr("sequence: primitive 1: wish 3: asks too much"));
  EXPECT_EQ(task.steps()[0].wishes.size(), 2u) << "what is refused changes nothing";
  Sequence hits;
  hits.then(reach).hit({{"y0", 0.4}}, {}, at(0.6 * reach.tau));
  EXPECT_THAT(refusal([&] { hits.until(at_end()); }), HasSubstr("hands over at its hit"));
  EXPECT_THAT(refusal([&] {
                hits.hit({{"y0", 0.3}}, {}, at(0.5 * reach.tau));
              }),
              HasSubstr("hands over for a second time"));
  Sequence::Step step{reach, Switch(), {}, hits.steps()[0].wishes, {}};
  EXPECT_EQ(Sequence().then(step).steps()[0].until.value, 0.6 * reach.tau);
  const Primitive wipe = test::random_primitive(random, 2, 20, Kind::rhythmic);
  Sequence round;
  round.then(wipe).enter(least_correction());
  EXPECT_THAT(refusal([&] { round.pass({{"y0", 0.3}}, at(-0.5)); }), HasSubstr("must be > 0"));
  EXPECT_THAT(refusal([&] { round.pass({{"y0", 0.3}}, at(50.0)); }), HasSubstr("the cycle"));
  Sequence late;
  late.then(reach).until(after(0.3 * reach.tau)).pass({{"y0", 0.4}}, at(0.5 * reach.tau));
  EXPECT_THAT(refusal([&] { late.then(reach); }), HasSubstr("wish 1 is for"));
  EXPECT_THAT(refusal([] { Sequence().arrive(); }), HasSubstr("before any primitive"));
}

TEST(Sequencer, HandsOverAtAHitThatMovesAndTellsThePrice) {
  std::mt19937_64 random(seed + 10);
  for (const Join method : all_joins) {
    const Primitive reach = test::random_primitive(random, 2, 15);
    const Primitive follow = test::random_primitive(random, 2, 15);
    const double moment = 0.7 * reach.tau;
    Sequence task;
    task.then(reach)
        .hit({{"y0", 0.5}, {"y1", 0.1}}, {{"y0", 0.3}, {"y1", -0.4}}, at(moment))
        .then(follow)
        .arrive();
    Sequencer sequencer(task, method, task.start_state());
    EXPECT_GT(largest(sequencer.join(0).price.deviation), 0.0);
    while (sequencer.time() < 0.4 * moment) sequencer.step(dt);
    const Wish later = hit(vector({0.55, 0.12}), vector({0.2, -0.4}), at(moment + 0.02 + 0.3e-3));
    EXPECT_FALSE(sequencer.set_wish(1, pass(vector({0.5, 0.1}), at(0.9 * reach.tau))))
        << "comes after the switch";
    EXPECT_TRUE(sequencer.set_wish(0, later));
    EXPECT_FALSE(sequencer.set_wish(0, pass(vector({0.5, 0.1}), at(moment)))) << "it is a hit";
    EXPECT_FALSE(sequencer.set_wish(1, later)) << "there is one";
    Sample last = sequencer.sample();
    while (sequencer.running() == 0) {
      last = sequencer.sample();
      sequencer.step(dt);
    }
    EXPECT_NEAR(sequencer.join(1).time, moment + 0.02 + 0.3e-3, 1e-12);
    EXPECT_NEAR(last.position(0), 0.55, 0.3 * dt);
    EXPECT_NEAR(last.velocity(1), -0.4, 1.0);
    if (method != Join::dmp2) {
      EXPECT_LE(
          largest(sequencer.join(1).acceleration_after - sequencer.join(1).acceleration_before),
          1e-9 * largest(sequencer.join(1).price.acceleration));
    }
    while (!sequencer.finished()) sequencer.step(dt);
    sequencer.step(2.0 * dt);
    EXPECT_LE(largest(sequencer.sample().position - follow.goal), 1e-9 * range(follow));
    EXPECT_FALSE(sequencer.set_wish(1, later)) << "it has arrived";
  }
}

TEST(Sequencer, KeepsWishesWhileTheRateChanges) {
  std::mt19937_64 random(seed + 11);
  const Primitive reach = test::random_primitive(random, 2, 15);
  Sequence task;
  task.then(reach).pass({{"y0", 0.5}}, at(0.6 * reach.tau)).arrive();
  Sequencer sequencer(task, Join::dmp2a, task.start_state());
  double nearest = 1.0;
  for (int k = 0; k < 8000; ++k) {
    if (k == 100) sequencer.set_rate(0.4, 0.2);
    sequencer.step(dt);
    const double now = sequencer.sample().position(0);
    if (std::abs(sequencer.own_time() - 0.6 * reach.tau) <= 0.5 * dt)
      nearest = std::min(nearest, std::abs(now - 0.5));
  }
  EXPECT_LE(nearest, 2e-3);
  EXPECT_LE(largest(sequencer.sample().position - reach.goal), 1e-9 * range(reach));
}

TEST(Sequencer, ResumesFromAMeasuredStateTowardsTheSameWishes) {
  std::mt19937_64 random(seed + 12);
  const Primitive reach = test::random_primitive(random, 2, 15);
  Sequence task;
  task.then(reach).pass({{"y0", 0.5}}, at(0.6 * reach.tau)).arrive();
  Sequencer sequencer(task, Join::dmp2a, task.start_state());
  const int ticks = static_cast<int>(0.3 * reach.tau / dt);
  for (int k = 0; k < ticks; ++k) sequencer.step(dt);
  Sample measured = sequencer.sample();
  measured.position.array() += 0.02;
  ASSERT_TRUE(sequencer.reinitialise(measured));
  EXPECT_TRUE(sequencer.wishes_hold());
  const auto advance = [&](double until) {
    while (sequencer.own_time() < until - dt) sequencer.step(dt);
    sequencer.step(until - sequencer.own_time());
  };
  advance(0.6 * reach.tau);
  EXPECT_NEAR(sequencer.sample().position(0), 0.5, 1e-9);
  advance(reach.tau);
  EXPECT_LE(largest(sequencer.sample().position - reach.goal), 1e-9 * range(reach));
}

}  // namespace
}  // namespace seam
