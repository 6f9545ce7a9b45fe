#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/execution.hpp>
#include <seam/join.hpp>
#include <seam/learn.hpp>

namespace seam {
namespace {

Sample random_state(std::mt19937_64& random, int dimensions) {
  std::normal_distribution<double> normal;
  const auto vector = [&](double scale) {
    return Eigen::VectorXd(
        Eigen::VectorXd::NullaryExpr(dimensions, [&] { return scale * normal(random); }));
  };
  Sample state(dimensions);
  state.position = vector(1.0);
  state.velocity = vector(1.0);
  state.acceleration = vector(10.0);
  return state;
}

TEST(Join, PositionAndVelocityContinueWithEveryMethod) {
  std::mt19937_64 random(10);
  for (int i = 0; i < 200; ++i) {
    Execution execution(test::random_primitive(random, 3));
    const Sample at = random_state(random, 3);
    for (const Join method : all_joins) {
      execution.reinitialise(at, 1.0, method);
      EXPECT_LT((execution.sample().position - at.position).cwiseAbs().maxCoeff(), 1e-14)
          << "seed 10, case " << i;
      EXPECT_EQ(execution.sample().velocity, at.velocity);
    }
  }
}

TEST(Join, AccelerationContinuesWithDmp2aAndDmp3) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 200; ++i) {
    Execution execution(test::random_primitive(random, 3));
    const Sample at = random_state(random, 3);
    for (const Join method : {Join::dmp2a, Join::dmp3}) {
      execution.reinitialise(at, 1.0, method);
      const double jump = (execution.sample().acceleration - at.acceleration).cwiseAbs().maxCoeff();
      EXPECT_LT(jump, 1e-11) << to_string(method) << ", seed 11, case " << i;
    }
  }
}

// Dmp2 leaves the step that Eq. 1 gives, worked out here by hand: fresh at the learned start, but
// moving.
TEST(Join, AccelerationStepsByTheDampingOfTheVelocityWithDmp2) {
  const Primitive primitive = learn(test::minimum_jerk());
  Execution execution(primitive);
  Sample at = Sample::at_rest(primitive.start_position);
  const double at_rest = execution.sample().acceleration(0);
  at.velocity(0) = 0.5;
  execution.reinitialise(at, 1.0, Join::dmp2);
  EXPECT_NEAR(execution.sample().acceleration(0) - at_rest, -2.0 * std::sqrt(200.0) * 0.5, 1e-12);
}

// Of all weights with the right forcing, those of dmp2a are nearest to the learned ones: any other
// change that keeps the forcing is orthogonal to theirs.
TEST(Join, Dmp2aChangesTheWeightsLeast) {
  std::mt19937_64 random(12);
  const Primitive primitive = test::random_primitive(random, 1);
  const Basis basis(primitive.kernels, primitive.alpha);
  Eigen::ArrayXd row(basis.count());
  basis.regressor(1.0, row);
  Eigen::MatrixXd weights = primitive.weights;
  Eigen::ArrayXd r(1);
  continue_from(random_state(random, 1), Join::dmp2a, primitive.gains, primitive.tau,
                primitive.goal, row, weights, r);
  const Eigen::VectorXd change = weights - primitive.weights;
  Eigen::VectorXd other = Eigen::VectorXd::Random(basis.count());
  other -= row.matrix() * other.dot(row.matrix()) / row.matrix().squaredNorm();
  EXPECT_NEAR(other.dot(change) / change.norm(), 0.0, 1e-12);
  EXPECT_EQ(r(0), primitive.goal(0));
}

TEST(Join, Dmp3LeavesTheWeightsAlone) {
  std::mt19937_64 random(13);
  const Primitive primitive = test::random_primitive(random, 2);
  Eigen::MatrixXd weights = primitive.weights;
  Eigen::ArrayXd row = Eigen::ArrayXd::Constant(10, 0.1);
  Eigen::ArrayXd r(2);
  continue_from(random_state(random, 2), Join::dmp3, primitive.gains, primitive.tau, primitive.goal,
                row, weights, r);
  EXPECT_EQ(weights, primitive.weights);
}

TEST(Join, HasNamesThatAreReadBack) {
  for (const Join method : all_joins) EXPECT_EQ(join_from_name(to_string(method)), method);
  EXPECT_EQ(test::refusal([] { join_from_name("dmp4"); }),
            "method \"dmp4\": not known, must be one of dmp2, dmp2a, dmp3");
}

// The price of smoothness: a minimum-jerk movement of 1 rad in 1 s begun at 0.5 rad/s. Peak jerk
// and largest deviation from dmp2, with the paper's gains, against figures computed independently
// when the methods were chosen.
struct Price {
  Join method;
  double jerk;       // [rad/s³]
  double deviation;  // [rad]
};

class JoinPrice : public testing::TestWithParam<Price> {};

TEST_P(JoinPrice, IsAsCalculatedIndependently) {
  LearnSettings settings;
  settings.gains = Gains::paper();
  const Primitive primitive = learn(test::minimum_jerk(), settings);
  Execution execution(primitive);
  Execution dmp2(primitive);
  Sample at = Sample::at_rest(primitive.start_position);
  at.velocity(0) = 0.5;
  execution.reinitialise(at, 1.0, GetParam().method);
  dmp2.reinitialise(at, 1.0, Join::dmp2);
  const double dt = 5e-4;
  double jerk = 0.0;
  double deviation = 0.0;
  for (double t = 0.0; t < 2.0; t += dt) {
    const double before = execution.sample().acceleration(0);
    execution.step(dt);
    dmp2.step(dt);
    jerk = std::max(jerk, std::abs(execution.sample().acceleration(0) - before) / dt);
    deviation =
        std::max(deviation, std::abs(execution.sample().position(0) - dmp2.sample().position(0)));
  }
  EXPECT_NEAR(jerk, GetParam().jerk, 1.0);
  EXPECT_NEAR(deviation, GetParam().deviation, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    , JoinPrice, testing::Values(Price{Join::dmp2a, 59.0, 0.029}, Price{Join::dmp3, 151.0, 0.021}),
    [](const auto& price) { return std::string(to_string(price.param.method)); });

}  // namespace
}  // namespace seam
