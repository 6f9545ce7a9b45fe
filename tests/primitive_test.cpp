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

TEST(Basis, RegressorSumsToThePhase) {
  const Basis basis(Kernels::even_in_time(10, 0.75, 2.0), 2.0);
  Eigen::ArrayXd row(10);
  for (const double x : {1.0, 0.7, 0.2, 0.01}) {
    basis.regressor(x, row);
    EXPECT_NEAR(row.sum(), x, 1e-15);
    EXPECT_GE(row.minCoeff(), 0.0);
  }
}

TEST(Basis, StaysFiniteWhereEveryKernelUnderflows) {
  const Basis basis(Kernels::even_in_time(80, 0.5, 2.0), 2.0);
  Eigen::ArrayXd row(80);
  for (const double x : {1e-3, 1e-12, 0.0}) {
    basis.regressor(x, row);
    EXPECT_NEAR(row.sum(), x, 1e-15) << x;
  }
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
