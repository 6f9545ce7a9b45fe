#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <seam/primitive.hpp>

namespace seam::test {

/// One coordinate of Eqs. 1-5 solved by the classical Runge-Kutta method in long double with many
/// small steps: an independent solution, which shares no code with the library's.
struct Ode {
  using Real = long double;

  Primitive primitive;
  std::vector<Real> weights;
  Real tau, goal;
  Real y, yd, r, x;  // state: position, velocity, filtered goal, phase

  Ode(const Primitive& from, int d, double position, double velocity)
      : primitive(from),
        tau(from.tau),
        goal(from.goal(d)),
        y(position),
        yd(velocity),
        r(from.goal(d)),
        x(1.0L) {
    for (int j = 0; j < from.kernels.count(); ++j) weights.push_back(from.weights(j, d));
  }

  Real forcing(Real phase) const {
    Real sum = 0.0L;
    Real weighted = 0.0L;
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const Real c = primitive.kernels.centers(static_cast<Eigen::Index>(j));
      const Real sigma = primitive.kernels.widths(static_cast<Eigen::Index>(j));
      const Real psi = std::exp(-(phase - c) * (phase - c) / (2.0L * sigma * sigma));
      sum += psi;
      weighted += weights[j] * psi;
    }
    return weighted / sum * phase;
  }

  Real acceleration() const { return slope({y, yd, r, x})[1]; }

  void advance(Real time, int steps) {
    const Real h = time / steps;
    for (int i = 0; i < steps; ++i) {
      const State s{y, yd, r, x};
      const State k1 = slope(s);
      const State k2 = slope(plus(s, k1, h / 2));
      const State k3 = slope(plus(s, k2, h / 2));
      const State k4 = slope(plus(s, k3, h));
      State sum{};
      for (std::size_t n = 0; n < 4; ++n)
        sum[n] = s[n] + h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
      y = sum[0], yd = sum[1], r = sum[2], x = sum[3];
    }
  }

 private:
  using State = std::array<Real, 4>;

  State slope(const State& s) const {
    const Gains& g = primitive.gains;
    const Real v = tau * s[1];
    const Real vd = (g.K * (s[2] - s[0]) - g.D * v + forcing(s[3])) / tau;
    return {s[1], vd / tau, g.H * (goal - s[2]) / tau, -Real(primitive.alpha) * s[3] / tau};
  }
  static State plus(const State& s, const State& k, Real h) {
    return {s[0] + h * k[0], s[1] + h * k[1], s[2] + h * k[2], s[3] + h * k[3]};
  }
};

}  // namespace seam::test
