#include <limits>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/basis.hpp>
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

TEST(Basis, TwoPhasesAtOnceGiveTheSameBitsAsEachAlone) {
  for (const Primitive& primitive :
       {primitive_with(Kind::discrete, Kernels::even_in_time(9, 0.75, 2.0)),
        primitive_with(Kind::rhythmic, Kernels::even_in_phase(9, 1.0))}) {
    const Basis basis(primitive);
    Eigen::VectorXd rows(18), first(9), second(9);
    basis.regressors(0.83, 0.31, rows.data());
    basis.regressor(0.83, first.data());
    basis.regressor(0.31, second.data());
    EXPECT_EQ(rows.head(9), first);
    EXPECT_EQ(rows.tail(9), second);
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
  EXPECT_EQ(message([](Primitive& p) { p.tau = 0.0; }), "primitive: tau 0.000000, must be > 0");
  EXPECT_EQ(message([](Primitive& p) { p.gains.K = -1.0; }), "primitive: K -1.000000, must be > 0");
  EXPECT_EQ(message([](Primitive& p) { p.goal(0) = NAN; }),
            "primitive: goal has an entry that is not finite");
  EXPECT_EQ(message([](Primitive& p) { p.weights(3, 1) = INFINITY; }),
            "primitive: weights have an entry that is not finite");
  EXPECT_EQ(message([](Primitive& p) { p.weights.resize(3, 2); }),
            "primitive: weights are 3 x 2, must be 10 x 2");
  EXPECT_EQ(message([](Primitive& p) { p.kernels.widths(4) = 0.0; }),
            "primitive: a kernel width is not > 0");
  EXPECT_EQ(message([](Primitive& p) {
              p.coordinates = {"a", "a"};
            }),
            "primitive: coordinate names repeat");
  EXPECT_EQ(message([](Primitive& p) { p.coordinates = {"a"}; }),
            "primitive: 1 coordinate names for 2 goals");
  EXPECT_EQ(message([](Primitive& p) { p.start_velocity.resize(3); }),
            "primitive: start_velocity has 3 entries, must have 2");
}

}  // namespace
}  // namespace seam
