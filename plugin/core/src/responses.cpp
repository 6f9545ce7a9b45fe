#include "responses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace seam {

namespace {

constexpr double least_phase = 0.01;              // where a discrete table ends
constexpr double shortest = 1.25, longest = 4.0;  // but no sooner and no later, in tau
constexpr double most_entries = 1e5;              // kernels times panels
constexpr double transitions = 0.6,
                 settling = 1.0;  // in a panel, at most: of the kernels, of the system

// Gauss's rule of five nodes on [0, 1].
constexpr std::array<double, 5> nodes{0.046910077030668018, 0.23076534494715845, 0.5,
                                      0.76923465505284155, 0.95308992296933198};
constexpr std::array<double, 5> shares{0.11846344252809454, 0.23931433524968324,
                                       0.28444444444444444, 0.23931433524968324,
                                       0.11846344252809454};

double end_of(const Primitive& primitive) {
  if (primitive.kind == Kind::rhythmic) return 4.0 * M_PI;
  return std::clamp(-std::log(least_phase) / primitive.alpha, shortest, longest);
}

// The shortest s over which one kernel gives way to the next, until an end: normalised Gaussians at a distance d cross over
// like a logistic function of scale sigma^2/d.
double sharpest(const Primitive& primitive, double end) {
  const bool discrete = primitive.kind == Kind::discrete;
  const double last = discrete ? std::exp(-primitive.alpha * end) : -HUGE_VAL;
  std::vector<std::pair<double, double>> kernels;
  for (int j = 0; j < primitive.kernels.count(); ++j)
    kernels.emplace_back(primitive.kernels.centers(j), primitive.kernels.widths(j));
  std::sort(kernels.begin(), kernels.end());
  double least = HUGE_VAL;
  for (std::size_t j = 0; j + 1 < kernels.size(); ++j) {
    const auto& [center, width] = kernels[j];
    const auto& [next, next_width] = kernels[j + 1];
    if (next < last) continue;
    const double sigma = std::min(width, next_width) * (discrete ? 1.0 : M_SQRT2);
    const double scale = std::min(sigma, sigma * sigma / (next - center));
    const double rate = discrete ? primitive.alpha * std::min(next, 1.0) : 1.0;
    least = std::min(least, scale / rate);
  }
  return least;
}

double fastest(const Gains& gains) {
  return gains.D * gains.D > 4.0 * gains.K ? gains.D : std::sqrt(gains.K);
}

}  // namespace

Responses::Responses(const Primitive& primitive) : gains_(primitive.gains), basis_(primitive) {
  const int M = basis_.count();
  const double end = end_of(primitive);
  const double longest_panel =
      std::min(transitions * sharpest(primitive, end), settling / fastest(gains_));
  const double panels = std::max(std::ceil(end / longest_panel), 8.0);
  const bool kept = panels * M <= most_entries;
  panel_ = kept ? end / panels : 0.0;
  table_.setZero(M, width * (kept ? static_cast<int>(panels) + 1 : 1));
  State state = State::Zero(M, 2);
  Eigen::VectorXd row(M);
  for (int i = 0; i <= this->panels(); ++i) {
    basis_.regressor(basis_.advance(basis_.start_phase(), i * panel_, 1.0), row.data());
    table_.middleCols<2>(width * i) = state;
    table_.col(width * i + 2) = row;
    if (i == this->panels()) break;
    add_panel(i * panel_, panel_, state, row);
  }
}

double Responses::at_phase(double phase) const noexcept {
  if (basis_.kind() == Kind::discrete)
    return std::max(0.0, basis_.time_to(phase, basis_.start_phase(), 1.0));
  return phase - 2.0 * M_PI * std::floor(phase / (2.0 * M_PI));
}

// The answer to an impulse, and its rate.
Responses::Pulse Responses::pulse(double s) const noexcept {
  const double d = 0.5 * gains_.D;
  const double square = gains_.K - d * d;
  const double omega = std::sqrt(std::abs(square));
  const bool swings = square > 0.0;
  const double decay = std::exp(swings ? -d * s : (omega - d) * s);
  double sine = s;
  double cosine = 1.0;
  if (swings) {
    sine = std::sin(omega * s) / omega;
    cosine = std::cos(omega * s);
  } else if (omega > 0.0) {
    sine = -std::expm1(-2.0 * omega * s) / (2.0 * omega);
    cosine = 1.0 - omega * sine;
  }
  return {decay * sine, decay * (cosine - d * sine)};
}

// E(s)·from, E the 2 × 2 exponential of the system at rest.
void Responses::evolve(double s, double sign, const Eigen::Ref<const State>& from,
                       Eigen::Ref<State> to) const noexcept {
  const Pulse left = pulse(s);
  to.col(0) += sign * ((left.rate + gains_.D * left.h) * from.col(0) + left.h * from.col(1));
  to.col(1) += sign * (left.rate * from.col(1) - gains_.K * left.h * from.col(0));
}

// Moves a state on over a panel, or a part of one.
void Responses::add_panel(double from, double length, Eigen::Ref<State> state,
                          Eigen::Ref<Eigen::VectorXd> row) const noexcept {
  const Pulse left = pulse(length);
  row = state.col(0);
  state.col(0) = (left.rate + gains_.D * left.h) * row + left.h * state.col(1);
  state.col(1) = left.rate * state.col(1) - gains_.K * left.h * row;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double phase = basis_.advance(basis_.start_phase(), from + nodes[i] * length, 1.0);
    basis_.regressor(phase, row.data());
    const Pulse answer = pulse((1.0 - nodes[i]) * length);
    state.col(0) += shares[i] * length * answer.h * row;
    state.col(1) += shares[i] * length * answer.rate * row;
  }
}

void Responses::state(double s, Eigen::Ref<State> state,
                      Eigen::Ref<Eigen::VectorXd> row) const noexcept {
  const int i = std::min(static_cast<int>(s / panel_), panels() - 1);
  state = point(i).leftCols<2>();
  add_panel(i * panel_, s - i * panel_, state, row);
}

void Responses::at_point(
    int i, double from, const State& begun,
    Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3>> answers) const noexcept {
  answers = point(i);
  evolve(i * panel_ - from, -1.0, begun, answers.leftCols<2>());
}

void Responses::rows(double from, const State& begun, double to,
                     Eigen::Ref<Rows> rows) const noexcept {
  state(to, rows.leftCols<2>(), rows.col(3));
  evolve(to - from, -1.0, begun, rows.leftCols<2>());
  const double phase = basis_.advance(basis_.start_phase(), to, 1.0);
  basis_.regressor(phase, rows.col(2).data());
  basis_.slope(phase, rows.col(2).data(), rows.col(3).data());
  rows.col(3) *= basis_.phase_rate(phase, 1.0);
  rows.col(2) -= gains_.K * rows.col(0) + gains_.D * rows.col(1);
  rows.col(3) -= gains_.K * rows.col(1) + gains_.D * rows.col(2);
}

}  // namespace seam
