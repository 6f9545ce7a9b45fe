#include <algorithm>
#include <array>
#include <cmath>

#include <seam/propagator.hpp>

namespace seam {

namespace {

constexpr int most_terms = 24;       // of a series for times in which no root turns or decays by 1
constexpr int most_halvings = 1100;  // of any time that a double holds
constexpr double negligible = 1e-22;

constexpr std::array<double, most_terms + 3> inverse_factorials() {
  std::array<double, most_terms + 3> values{1.0};
  for (std::size_t n = 1; n < values.size(); ++n)
    values[n] = values[n - 1] / static_cast<double>(n);
  return values;
}
constexpr auto over_factorial = inverse_factorials();

// e and ė (in units of λ) after a time in which l = λt goes by.
Eigen::Matrix2d critically_damped(double l) {
  Eigen::Matrix2d flow;
  flow << 1.0 + l, l, -l, 1.0 - l;
  return std::exp(-l) * flow;
}

// The system over a time: what y and ẏ become of themselves, of e and ė, and of a forcing and its first two derivatives.
struct Flow {
  Eigen::Matrix2d spring, coupling;
  Eigen::Matrix<double, 2, 3> driven;

  Flow(double p, double q, double d, double c, double l) noexcept;
  void double_time(double l) noexcept;
};

// Taylor's series over a unit of time of
//     y' = pv,  v' = −qy − dv + c(f + e),  e' = lė,  ė' = −l(e + 2ė)
// whose solutions are made of γ'' = −dγ' − pqγ from γ = 0, γ' = 1, its integrals, and x'' = −dx' − pqx + e from 0.
Flow::Flow(double p, double q, double d, double c, double l) noexcept {
  double g = 0.0, g_next = 1.0;  // the n-th and the next derivative of γ
  Eigen::Array2d x(0.0, 0.0), x_next(0.0, 0.0);
  Eigen::Array2d e(1.0, 0.0), e_next(0.0, l);  // of one that begins with e = 1, and one with ė = 1
  Eigen::Array4d gamma = Eigen::Array4d::Zero();  // γ and its integrals
  double gamma_rate = 0.0;
  Eigen::Array2d response(0.0, 0.0), response_rate(0.0, 0.0);
  const double reach = 2.0 * std::max({p, q, d, l});
  double size = 1.0;
  for (std::size_t n = 0; n < most_terms && size > negligible; ++n) {
    for (std::size_t k = 0; k < 4; ++k)
      gamma[static_cast<Eigen::Index>(k)] += g * over_factorial[n + k];
    gamma_rate += g_next * over_factorial[n];
    response += x * over_factorial[n];
    response_rate += x_next * over_factorial[n];
    const double g_after = -d * g_next - p * q * g;
    const Eigen::Array2d x_after = -d * x_next - p * q * x + e;
    const Eigen::Array2d e_after = -2.0 * l * e_next - l * l * e;
    g = g_next, g_next = g_after;
    x = x_next, x_next = x_after;
    e = e_next, e_next = e_after;
    size *= reach / static_cast<double>(n + 1);
  }
  spring << gamma_rate + d * gamma(0), p * gamma(0), -q * gamma(0), gamma_rate;
  coupling << p * c * response.transpose().matrix(), c * response_rate.transpose().matrix();
  driven << p * c * gamma.tail<3>().transpose().matrix(), c * gamma.head<3>().transpose().matrix();
}

// l of the time that is doubled; the derivatives of the forcing are those by the time itself.
void Flow::double_time(double l) noexcept {
  Eigen::Matrix3d onwards;
  onwards << 1.0, 1.0, 0.5, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0;
  driven = (spring * driven + driven * onwards).eval();
  driven *= Eigen::Vector3d(1.0, 0.5, 0.25).asDiagonal();
  coupling = (spring * coupling + coupling * critically_damped(l)).eval();
  spring = (spring * spring).eval();
}

}  // namespace

Propagator::Propagator(const Gains& gains, double tau, double dt) noexcept {
  // With velocities in this unit, over τ, the spring's two entries are alike; ė is in units of H/τ.
  const double stiffness = std::max(1.0, std::sqrt(gains.K));
  const double s = dt / tau;
  const double fastest = s * std::max({stiffness, gains.D, gains.H});
  const int halvings = std::clamp(std::ilogb(fastest), -2, most_halvings) + 2;
  const double part = std::ldexp(s, -halvings);
  double l = gains.H * part;
  Flow flow(stiffness * part, gains.K / stiffness * part, gains.D * part, part / stiffness, l);
  for (int i = 0; i < halvings; ++i, l *= 2.0) flow.double_time(l);

  const double unit = stiffness / tau;
  const double decay = gains.H / tau;
  Phi << flow.spring, flow.coupling, Eigen::Matrix2d::Zero(), critically_damped(l);
  const Eigen::Array4d units(1.0, unit, 1.0, decay);
  Phi = (units.matrix().asDiagonal() * Phi * units.inverse().matrix().asDiagonal()).eval();
  Eigen::Matrix3d derivatives_from_nodes;
  derivatives_from_nodes << 1.0, 0.0, 0.0,  //
      -3.0, 4.0, -1.0,                      //
      4.0, -8.0, 4.0;
  Gamma = flow.driven * derivatives_from_nodes;
  Gamma.row(1) *= unit;
}

}  // namespace seam
