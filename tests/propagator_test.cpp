#include <gtest/gtest.h>

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
      const Eigen::Vector3d e = step.Phi * Eigen::Vector3d(0.7, -1.3, 0.0);
      const double decay = std::exp(-w * dt);
      EXPECT_NEAR(e(0), (0.7 + (-1.3 + w * 0.7) * dt) * decay, 1e-13);
      EXPECT_NEAR(e(1), (-1.3 - w * (-1.3 + w * 0.7) * dt) * decay, 2e-12);
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
        const Eigen::Vector3d e = step.Phi * Eigen::Vector3d(0.7, 0.0, 0.0);
        EXPECT_NEAR(e(0), 0.7 * std::cos(w * dt), 1e-10) << K << ", " << tau << ", " << steps;
        EXPECT_NEAR(e(1), -0.7 * w * std::sin(w * dt), 1e-10 * w) << K << ", " << tau;
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
  const Eigen::Vector3d e = step.Gamma * Eigen::Vector3d::Ones();
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
    const Eigen::Vector3d e = step.Gamma * Eigen::Vector3d(f(0.0), f(0.5 * dt), f(dt));
    EXPECT_NEAR(e(0), 0.5 * dt * dt, 1e-13);
    EXPECT_NEAR(e(1), dt, 1e-12);
  }
}

}  // namespace
}  // namespace seam
