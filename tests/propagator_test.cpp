#include <random>

#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

#include <seam/propagator.hpp>

namespace seam {
namespace {

// Critically damped, unforced, r = g: e(t) = (e₀ + (ė₀ + ωe₀)t)·exp(−ωt) with ω = √K/τ.
TEST(Propagator, MatchesTheClosedFormOfACriticallyDampedSpring) {
  const Gains gains = Gains::critical(200.0);
  for (const double tau : {0.3, 1.0, 4.0})
    for (const double dt : {1e-4, 1e-2, 0.5, 20.0}) {
      const Propagator step(gains, tau, dt);
      const double w = std::sqrt(200.0) / tau;
      const Eigen::Vector4d e = step.Phi * Eigen::Vector4d(0.7, -1.3, 0.0, 0.0);
      const double decay = std::exp(-w * dt);
      EXPECT_NEAR(e(0), (0.7 + (-1.3 + w * 0.7) * dt) * decay, 1e-13);
      EXPECT_NEAR(e(1), (-1.3 - w * (-1.3 + w * 0.7) * dt) * decay, 2e-12);
    }
}

// The added forcing on its own: (e₀ + (ė₀ + λe₀)t)·exp(−λt), and e₀·exp(−λt) where ė₀ = −λe₀.
TEST(Propagator, MatchesTheClosedFormOfTheAddedForcing) {
  const Gains gains = Gains::paper();
  for (const double tau : {0.3, 1.0, 4.0})
    for (const double dt : {1e-4, 1e-2, 0.5}) {
      const Propagator step(gains, tau, dt);
      const double h = gains.H / tau;
      const double decay = std::exp(-h * dt);
      const Eigen::Vector4d both = step.Phi * Eigen::Vector4d(0.0, 0.0, 0.7, -1.3);
      EXPECT_NEAR(both(2), (0.7 + (-1.3 + h * 0.7) * dt) * decay, 1e-13);
      EXPECT_NEAR(both(3), (-1.3 - h * (-1.3 + h * 0.7) * dt) * decay, 1e-11);
      const Eigen::Vector4d first = step.Phi * Eigen::Vector4d(0.0, 0.0, 0.7, -0.7 * h);
      EXPECT_NEAR(first(2), 0.7 * decay, 1e-14);
    }
}

// The filtered goal of Eq. 5 with triple pole w: (y − g)(t) = w²t²/2·(r₀ − g)·exp(−wt).
TEST(Propagator, MatchesTheClosedFormOfTheFilteredGoal) {
  const Gains gains = Gains::critical(200.0);
  const double w = std::sqrt(200.0) / 0.8;
  for (const double dt : {1e-3, 0.05, 0.4}) {
    const Propagator step(gains, 0.8, dt);
    const Eigen::Vector4d e = step.Phi * Eigen::Vector4d(0.0, 0.0, 200.0 * 0.3, -200.0 * 0.3 * w);
    EXPECT_NEAR(e(0), 0.5 * w * w * dt * dt * 0.3 * std::exp(-w * dt), 1e-14);
  }
}

// Undamped, unforced: e(t) = e₀ cos(ωt) with ω = √K/τ, through up to a hundred turns in a step.
TEST(Propagator, MatchesTheClosedFormOfAnUndampedSpringOfAnyTimeAndStiffness) {
  for (const double K : {1.0, 200.0, 1e5})
    for (const double tau : {1e-6, 1e-3, 1.0, 1e9})
      for (const double steps : {1.0, 7.0, 200.0}) {
        const double dt = 2.0 * tau / steps;
        const double w = std::sqrt(K) / tau;
        const Propagator step({K, 0.0, std::sqrt(K)}, tau, dt);
        const Eigen::Vector4d e = step.Phi * Eigen::Vector4d(0.7, 0.0, 0.0, 0.0);
        EXPECT_NEAR(e(0), 0.7 * std::cos(w * dt), 1e-10) << K << ", " << tau << ", " << steps;
        EXPECT_NEAR(e(1), -0.7 * w * std::sin(w * dt), 1e-10 * w) << K << ", " << tau;
      }
}

// Van Loan's: the exponential of the system together with its forcing and the forcing's derivatives. Entries that hold
// velocities are compared in units of √K/τ.
TEST(Propagator, MatchesTheExponentialOfTheWholeSystem) {
  std::mt19937 random(1);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 500; ++i) {
    const double K = std::pow(10.0, between(-1.0, 3.0));
    const Gains gains{K, std::sqrt(K) * between(0.0, 4.0), std::sqrt(K) * between(0.1, 3.0)};
    const double tau = std::pow(10.0, between(-1.0, 1.0));
    const double dt = tau * std::pow(10.0, between(-4.0, 0.0));
    const double lambda = gains.H / tau;
    Eigen::Matrix<double, 7, 7> generator = Eigen::Matrix<double, 7, 7>::Zero();
    generator(0, 1) = 1.0;
    generator.row(1) << -K / (tau * tau), -gains.D / tau, 1.0 / (tau * tau), 0.0, 1.0 / (tau * tau),
        0.0, 0.0;
    generator.row(3) << 0.0, 0.0, -lambda * lambda, -2.0 * lambda, 0.0, 0.0, 0.0;
    generator(2, 3) = generator(4, 5) = generator(5, 6) = 1.0;
    const Eigen::Matrix<double, 7, 7> flow = (generator * dt).exp();
    const Eigen::Vector3d rates(0.3, -1.2 / dt, 2.0 / (dt * dt));  // f and its derivatives
    const auto f = [&](double t) { return rates(0) + rates(1) * t + 0.5 * rates(2) * t * t; };
    const Propagator step(gains, tau, dt);
    const Eigen::Vector2d driven = step.Gamma * Eigen::Vector3d(f(0.0), f(0.5 * dt), f(dt));
    const Eigen::Vector2d expected = flow.topRightCorner<2, 3>() * rates;
    const double unit = std::sqrt(K) / tau;
    EXPECT_NEAR(driven(0), expected(0), 1e-12 / std::min(K, 1.0)) << K << ", " << dt / tau;
    EXPECT_NEAR(driven(1), expected(1), 1e-12 * unit / std::min(K, 1.0)) << K << ", " << dt / tau;
    const Eigen::Vector4d units(1.0, unit, 1.0, lambda);
    const Eigen::Matrix4d off =
        units.asDiagonal().inverse() * (step.Phi - flow.topLeftCorner<4, 4>()) * units.asDiagonal();
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-11) << K << ", " << gains.D << ", " << dt / tau;
  }
}

TEST(Propagator, TwoHalfStepsMakeAWhole) {
  const Propagator whole(Gains::paper(), 0.8, 0.02);
  const Propagator half(Gains::paper(), 0.8, 0.01);
  EXPECT_LT((half.Phi * half.Phi - whole.Phi).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Propagator, AConstantForcingMovesTheEquilibriumByItsShareOfK) {
  const Gains gains = Gains::critical(150.0);
  const Propagator step(gains, 1.0, 100.0);
  const Eigen::Vector2d e = step.Gamma * Eigen::Vector3d::Ones();
  EXPECT_NEAR(e(0), 1.0 / 150.0, 1e-14);
  EXPECT_NEAR(e(1), 0.0, 1e-13);
}

// y(t) = t²/2 solves τ²ÿ = −Ky − Dτẏ + f with the quadratic f = τ² + Dτt + Kt²/2: no error at any
// step length.
TEST(Propagator, IsExactForAQuadraticForcing) {
  const Gains gains = Gains::paper();
  const double tau = 0.7;
  const auto f = [&](double t) { return tau * tau + gains.D * tau * t + 0.5 * gains.K * t * t; };
  for (const double dt : {1e-3, 0.05, 1.0}) {
    const Propagator step(gains, tau, dt);
    const Eigen::Vector2d e = step.Gamma * Eigen::Vector3d(f(0.0), f(0.5 * dt), f(dt));
    EXPECT_NEAR(e(0), 0.5 * dt * dt, 1e-13);
    EXPECT_NEAR(e(1), dt, 1e-12);
  }
}

}  // namespace
}  // namespace seam
