#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <seam/primitive.hpp>

namespace seam::test {

/// One coordinate of Eqs. 1-5, 9-11 solved by the classical Runge-Kutta method in long double with many small steps: an
/// independent solution, which shares no code with the library's. Joins are written out as the paper prints them, with
/// its misprints put right.
struct Ode {
  using Real = long double;
  using State = std::array<Real, 4>;  // y, ẏ, r, phase

  Primitive primitive;
  std::vector<Real> weights, change;
  Real tau, goal;
  Real y, yd, r, p;
  Real elapsed = 0.0L;  // since the weights were changed

  Ode(const Primitive& from, int d, Real position, Real velocity, Real phase)
      : primitive(from),
        tau(from.tau),
        goal(from.goal(d)),
        y(position),
        yd(velocity),
        r(from.goal(d)),
        p(phase) {
    for (int j = 0; j < from.kernels.count(); ++j) weights.push_back(from.weights(j, d));
    change.assign(weights.size(), 0.0L);
  }

  bool rhythmic() const { return primitive.kind == Kind::rhythmic; }

  std::vector<Real> kernels(Real phase) const {
    std::vector<Real> psi;
    for (int j = 0; j < primitive.kernels.count(); ++j) {
      const Real from_center = phase - Real(primitive.kernels.centers(j));
      const Real sigma = primitive.kernels.widths(j);
      const Real distance = rhythmic() ? 1.0L - std::cos(from_center) : from_center * from_center;
      psi.push_back(std::exp(-distance / (2.0L * sigma * sigma)));
    }
    return psi;
  }

  /// The changed weights of a rhythmic primitive return to the learned ones over half a cycle.
  Real share(Real time) const {
    const Real s = time / (3.14159265358979323846264338327950288L * tau);
    if (!rhythmic()) return 1.0L;
    return s < 1.0L ? 1.0L - s * s * s * (10.0L - 15.0L * s + 6.0L * s * s) : 0.0L;
  }

  Real forcing(Real phase, Real time) const {
    const std::vector<Real> psi = kernels(phase);
    Real sum = 0.0L;
    Real weighted = 0.0L;
    for (std::size_t j = 0; j < psi.size(); ++j) {
      sum += psi[j];
      weighted += (weights[j] + share(time) * change[j]) * psi[j];
    }
    return weighted / sum * (rhythmic() ? 1.0L : phase);
  }

  Real acceleration() const { return slope({y, yd, r, p}, elapsed)[1]; }

  /// Eq. 6: the filtered goal that gives an acceleration.
  void join_dmp3(Real ydd) {
    const Gains& g = primitive.gains;
    r = (tau * tau * ydd + g.D * tau * yd - forcing(p, 0.0L)) / g.K + y;
  }

  /// Eqs. 19 and 21: the smallest change of the weights that gives an acceleration.
  void join_dmp2a(Real ydd) {
    const Gains& g = primitive.gains;
    const Real needed = tau * tau * ydd + g.D * tau * yd - g.K * (goal - y);
    const std::vector<Real> psi = kernels(p);
    Real sum = 0.0L;
    Real squares = 0.0L;
    Real weighted = 0.0L;
    for (std::size_t j = 0; j < psi.size(); ++j) {
      sum += psi[j];
      squares += psi[j] * psi[j];
      weighted += weights[j] * psi[j];
    }
    const Real missing = needed * sum / (rhythmic() ? 1.0L : p) - weighted;
    for (std::size_t j = 0; j < psi.size(); ++j) change[j] = psi[j] / squares * missing;
  }

  void advance(Real time, int steps) {
    const Real h = time / steps;
    for (int i = 0; i < steps; ++i) {
      const State s{y, yd, r, p};
      const State k1 = slope(s, elapsed);
      const State k2 = slope(plus(s, k1, h / 2), elapsed + h / 2);
      const State k3 = slope(plus(s, k2, h / 2), elapsed + h / 2);
      const State k4 = slope(plus(s, k3, h), elapsed + h);
      State sum{};
      for (std::size_t n = 0; n < 4; ++n)
        sum[n] = s[n] + h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
      y = sum[0], yd = sum[1], r = sum[2], p = sum[3];
      elapsed += h;
    }
  }

 private:
  State slope(const State& s, Real time) const {
    const Gains& g = primitive.gains;
    const Real v = tau * s[1];
    const Real vd = (g.K * (s[2] - s[0]) - g.D * v + forcing(s[3], time)) / tau;
    const Real pd = rhythmic() ? 1.0L / tau : -Real(primitive.alpha) * s[3] / tau;
    return {s[1], vd / tau, g.H * (goal - s[2]) / tau, pd};
  }
  static State plus(const State& s, const State& k, Real h) {
    return {s[0] + h * k[0], s[1] + h * k[1], s[2] + h * k[2], s[3] + h * k[3]};
  }
};

}  // namespace seam::test
