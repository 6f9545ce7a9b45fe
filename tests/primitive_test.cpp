#include <array>
#include <functional>
#include <limits>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/basis.hpp>
#include <seam/execution.hpp>
#include <seam/primitive.hpp>

namespace seam {
namespace {

using test::refusal;

TEST(Kernels, CentresAreEvenInTime) {
  const Kernels kernels = Kernels::even_in_time(10, 0.75, 2.0);
  EXPECT_DOUBLE_EQ(kernels.centers(0), 1.0);
  EXPECT_DOUBLE_EQ(kernels.centers(9), std::exp(-2.0));
  for (int j = 0; j < 10; ++j) EXPECT_NEAR(-std::log(kernels.centers(j)) / 2.0, j / 9.0, 1e-15);
  EXPECT_DOUBLE_EQ(kernels.widths(0), 0.75 * (1.0 - kernels.centers(1)));
  EXPECT_DOUBLE_EQ(kernels.widths(9), kernels.widths(8));
}

TEST(Kernels, RefusesSettingsOutOfRange) {
  EXPECT_EQ(refusal([] { Kernels::even_in_time(1, 0.75, 2.0); }), "kernels: count 1, must be >= 2");
  EXPECT_THAT(refusal([] { Kernels::even_in_time(10, -0.5, 2.0); }),
              testing::HasSubstr("width -0.5"));
  EXPECT_THAT(refusal([] { Kernels::even_in_time(10, 0.5, NAN); }),
              testing::HasSubstr("alpha nan"));
}

TEST(Gains, DefaultToATriplePole) {
  const Gains gains;
  EXPECT_DOUBLE_EQ(gains.D * gains.D, 4.0 * gains.K);
  EXPECT_DOUBLE_EQ(gains.H * gains.H, gains.K);
  EXPECT_EQ(Gains::paper().D, 28.0);
}

Primitive primitive_with(Kind kind, const Kernels& kernels) {
  Primitive primitive;
  primitive.kind = kind;
  primitive.kernels = kernels;
  return primitive;
}

TEST(Kernels, CentresAreEvenOverACycle) {
  const Kernels kernels = Kernels::even_in_phase(20, 1.0);
  for (int j = 0; j < 20; ++j) EXPECT_NEAR(kernels.centers(j), 2.0 * M_PI * j / 20.0, 1e-14);
  EXPECT_TRUE((kernels.widths.array() == 2.0 * M_PI / 20.0).all());
}

// The formula as it is printed, Eqs. 2, 3, 9, 10, in long double.
Eigen::VectorXd printed_regressor(const Primitive& primitive, double phase) {
  using Real = long double;
  const bool discrete = primitive.kind == Kind::discrete;
  std::vector<Real> psi;
  Real sum = 0.0L;
  for (int j = 0; j < primitive.kernels.count(); ++j) {
    const Real from_center = Real(phase) - Real(primitive.kernels.centers(j));
    const Real sigma = primitive.kernels.widths(j);
    const Real distance = discrete ? from_center * from_center : 1.0L - std::cos(from_center);
    psi.push_back(std::exp(-distance / (2.0L * sigma * sigma)));
    sum += psi.back();
  }
  Eigen::VectorXd row(primitive.kernels.count());
  for (int j = 0; j < row.size(); ++j)
    row(j) = static_cast<double>((discrete ? Real(phase) : 1.0L) *
                                 psi[static_cast<std::size_t>(j)] / sum);
  return row;
}

TEST(Basis, RegressorIsThePrintedFormula) {
  for (const int M : {2, 5, 10, 13}) {
    const Primitive discrete = primitive_with(Kind::discrete, Kernels::even_in_time(M, 0.75, 2.0));
    const Primitive rhythmic = primitive_with(Kind::rhythmic, Kernels::even_in_phase(M, 1.0));
    Eigen::VectorXd row(M);
    for (const double phase : {1.0, 0.73, 0.2, 0.01}) {
      Basis(discrete).regressor(phase, row.data());
      EXPECT_LT((row - printed_regressor(discrete, phase)).cwiseAbs().maxCoeff(), 3e-15) << M;
      Basis(rhythmic).regressor(7.0 * phase, row.data());
      EXPECT_LT((row - printed_regressor(rhythmic, 7.0 * phase)).cwiseAbs().maxCoeff(), 3e-15) << M;
    }
  }
}

TEST(Basis, ForcingIsTheRegressorTimesTheWeightsAtBothPhases) {
  for (const int M : {2, 9, 12})
    for (const int D : {1, 7, 8, 11})
      for (const Primitive& primitive :
           {primitive_with(Kind::discrete, Kernels::even_in_time(M, 0.75, 2.0)),
            primitive_with(Kind::rhythmic, Kernels::even_in_phase(M, 1.0)),
            primitive_with(Kind::discrete, Kernels::even_in_time(M, 0.02, 2.0))}) {
        const Basis basis(primitive);
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        Rows weights = Rows::Zero((M + 3) / 4 * 4, (D + 3) / 4 * 4);
        weights.topLeftCorner(M, D).setRandom();
        Eigen::VectorXd first(weights.cols()), second(weights.cols()), row(M);
        basis.forcing(0.83, 0.31, weights.data(), static_cast<int>(weights.cols()), first.data(),
                      second.data());
        basis.regressor(0.83, row.data());
        EXPECT_LT((first - weights.topRows(M).transpose() * row).cwiseAbs().maxCoeff(), 1e-14);
        basis.regressor(0.31, row.data());
        EXPECT_LT((second - weights.topRows(M).transpose() * row).cwiseAbs().maxCoeff(), 1e-14);
      }
}

TEST(Basis, SlopeIsTheDerivativeOfTheRegressor) {
  for (const Primitive& primitive :
       {primitive_with(Kind::discrete, Kernels::even_in_time(10, 0.75, 2.0)),
        primitive_with(Kind::rhythmic, Kernels::even_in_phase(10, 1.0))}) {
    const Basis basis(primitive);
    Eigen::VectorXd row(10), before(10), after(10), slope(10);
    for (const double phase : {0.9, 0.5, 0.2}) {
      const double h = 1e-6;
      basis.regressor(phase - h, before.data());
      basis.regressor(phase + h, after.data());
      basis.regressor(phase, row.data());
      basis.slope(phase, row.data(), slope.data());
      EXPECT_LT((slope - (after - before) / (2.0 * h)).cwiseAbs().maxCoeff(), 1e-7);
    }
  }
}

TEST(Basis, StaysFiniteWhereEveryKernelUnderflows) {
  const Basis basis(primitive_with(Kind::discrete, Kernels::even_in_time(80, 0.5, 2.0)));
  Eigen::VectorXd row(80), slope(80);
  for (const double x : {1e-3, 1e-12, 0.0}) {
    basis.regressor(x, row.data());
    EXPECT_NEAR(row.sum(), x, 1e-15) << x;
    basis.slope(x, row.data(), slope.data());
    EXPECT_TRUE(slope.allFinite()) << x;
  }
}

TEST(Basis, KnowsWhenAPhaseComes) {
  const Basis discrete(primitive_with(Kind::discrete, Kernels::even_in_time(5, 0.75, 2.0)));
  EXPECT_NEAR(discrete.advance(0.8, discrete.time_to(0.3, 0.8, 1.7), 1.7), 0.3, 1e-15);
  const Basis rhythmic(primitive_with(Kind::rhythmic, Kernels::even_in_phase(5, 1.0)));
  EXPECT_NEAR(rhythmic.next(1.0, 0.5), 1.0, 1e-15);
  EXPECT_NEAR(rhythmic.next(1.0, 1.5), 1.0 + 2.0 * M_PI, 1e-14);
  EXPECT_NEAR(rhythmic.advance(1.5, rhythmic.time_to(rhythmic.next(1.0, 1.5), 1.5, 0.2), 0.2),
              1.0 + 2.0 * M_PI, 1e-14);
}

TEST(Primitive, RefusesWhatCannotBeExecuted) {
  std::mt19937_64 random(2);
  const Primitive good = test::random_primitive(random, 2);
  EXPECT_NO_THROW(good.validate());
  const auto message = [&](const std::function<void(Primitive&)>& spoil) {
    Primitive bad = good;
    spoil(bad);
    return refusal([&] { bad.validate(); });
  };
  EXPECT_EQ(message([](Primitive& p) { p.tau = 0.0; }),
            "primitive: tau 0, must be in 1e-06 to 1e+09");
  EXPECT_EQ(message([](Primitive& p) { p.gains.K = -1.0; }),
            "primitive: K -1, must be in 1e-06 to 1e+06");
  EXPECT_EQ(message([](Primitive& p) { p.goal(0) = NAN; }),
            "primitive: goal: an entry is nan, must be in -1e+30 to 1e+30");
  EXPECT_EQ(message([](Primitive& p) { p.weights(3, 1) = INFINITY; }),
            "primitive: weights: an entry is inf, must be in -1e+30 to 1e+30");
  EXPECT_EQ(message([](Primitive& p) { p.weights.resize(3, 2); }),
            "primitive: weights are 3 x 2, must be 10 x 2");
  EXPECT_EQ(message([](Primitive& p) { p.kernels.widths(4) = 0.0; }),
            "primitive: widths: an entry is 0, must be in 1e-09 to 1e+09");
  EXPECT_EQ(message([](Primitive& p) {
              p.coordinates = {"a", "a"};
            }),
            "primitive: coordinate names repeat");
  EXPECT_EQ(message([](Primitive& p) { p.coordinates = {"a"}; }),
            "primitive: 1 coordinate names for 2 goals");
  EXPECT_EQ(message([](Primitive& p) { p.start_velocity.resize(3); }),
            "primitive: start_velocity has 3 entries, must have 2");
  EXPECT_EQ(message([](Primitive& p) { p.reference_orientation = Eigen::Quaterniond::Identity(); }),
            "primitive: reference orientation 0 0 0 1, must have the coordinates rx, ry and rz");
  EXPECT_EQ(
      message([](Primitive& p) { p.reference_orientation = Eigen::Quaterniond(1.001, 0, 0, 0); }),
      "primitive: reference orientation 0 0 0 1.001 of norm 1.001, must be 1 within 1e-9");
  EXPECT_THAT(
      message([](Primitive& p) { p.reference_orientation = Eigen::Quaterniond(NAN, 0, 0, 0); }),
      testing::HasSubstr("of norm nan"));
}

// What was seen to give NaN or infinity when it was played, or a motion that grows without end.
TEST(Primitive, RefusesWhatWouldNotStayFinite) {
  std::mt19937_64 random(3);
  const Primitive good = test::random_primitive(random, 2);
  const std::function<void(Primitive&)> spoilers[] = {
      [](Primitive& p) { p.kernels.widths(2) = 1e-160; },
      [](Primitive& p) { p.kernels.centers(2) = 1e200; },
      [](Primitive& p) { p.gains.K = 1e20; },
      [](Primitive& p) { p.gains.D = 1e300; },
      [](Primitive& p) { p.alpha = 1e-300; },
      [](Primitive& p) { p.tau = 1e-9; },
      [](Primitive& p) { p.tau = 1e300; },
  };
  for (const auto& spoil : spoilers) {
    Primitive bad = good;
    spoil(bad);
    EXPECT_THAT(refusal([&] { bad.validate(); }), testing::HasSubstr("must be in")) << bad.tau;
  }
}

// At one end of its bounds or the other in every number, or between.
Primitive primitive_at_the_bounds(std::mt19937_64& random, Kind kind) {
  const auto at = [&](const Bounds& bounds, double inside) {
    const auto which = random() % 3;
    return which == 0 ? bounds.least : which == 1 ? bounds.largest : inside;
  };
  Primitive p = test::random_primitive(random, 2, 10, kind);
  p.gains = {at(gain_bounds, p.gains.K), at(gain_bounds, p.gains.D), at(gain_bounds, p.gains.H)};
  p.alpha = at(alpha_bounds, p.alpha);
  p.tau = at(tau_bounds, p.tau);
  for (double& center : p.kernels.centers) center = at(center_bounds, center);
  for (double& width : p.kernels.widths) width = at(width_bounds, width);
  for (double& weight : p.weights.reshaped()) weight = at(value_bounds, weight);
  for (Eigen::VectorXd* vector :
       {&p.goal, &p.start_position, &p.start_velocity, &p.start_acceleration})
    for (double& value : *vector) value = at(value_bounds, value);
  return p;
}

bool is_finite(const Sample& at) {
  return at.position.allFinite() && at.velocity.allFinite() && at.acceleration.allFinite() &&
         at.jerk.allFinite();
}

TEST(Primitive, StaysFiniteAtTheBoundsForTwiceItsTimeWithEveryMethod) {
  constexpr unsigned seed = 4;
  std::mt19937_64 random(seed);
  for (int i = 0; i < 400; ++i) {
    const Primitive primitive =
        primitive_at_the_bounds(random, random() % 2 ? Kind::rhythmic : Kind::discrete);
    Sample start(2);
    start.position = primitive.start_position;
    start.velocity = start.jerk = primitive.start_velocity;
    start.acceleration = primitive.start_acceleration;
    for (const Join method : all_joins) {
      const int steps = std::array{1, 7, 200}[random() % 3];
      Execution execution(primitive);
      execution.reinitialise(start, execution.basis().start_phase(), method);
      bool finite = is_finite(execution.state());
      for (int k = 0; k < steps; ++k) {
        execution.step(2.0 * primitive.tau / steps);
        finite = finite && is_finite(execution.state());
      }
      EXPECT_TRUE(finite) << "seed " << seed << ", case " << i << ", " << to_string(method);
    }
  }
}

}  // namespace
}  // namespace seam
