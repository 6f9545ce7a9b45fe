#include <algorithm>
#include <cmath>
#include <limits>

#include "vectors.hpp"
#include <seam/basis.hpp>

namespace seam {

namespace {

// exp(y) for y ≤ 0 to the last bit or two; flat below −700.
// y = n·ln 2 + r, |r| ≤ ln 2/2, and the Taylor polynomial of degree 13 in r.
__attribute__((always_inline)) inline void exp_nonpositive(Lanes& y) {
  const Lanes floor = y - y - 700.0;
  const Lanes clamped = y > floor ? y : floor;
  const Lanes shifted = clamped * 0x1.71547652b82fep0 + 0x1.8p52;
  const Lanes n = shifted - 0x1.8p52;
  const Lanes r = (clamped - n * 0x1.62e42fefa0000p-1) - n * 0x1.cf79abc9e3b3ap-40;
  const Lanes r2 = r * r;
  const Lanes r4 = r2 * r2;
  const Lanes low =
      (1.0 + r) + r2 * (0.5 + r * (1.0 / 6.0)) +
      r4 * ((1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0 + r * (1.0 / 5040.0)));
  const Lanes high = (1.0 / 40320.0 + r * (1.0 / 362880.0)) +
                     r2 * (1.0 / 3628800.0 + r * (1.0 / 39916800.0)) +
                     r4 * (1.0 / 479001600.0 + r * (1.0 / 6227020800.0));
  const IntegerLanes power = (reinterpret_cast<const IntegerLanes&>(shifted) + 1023) << 52;
  y = (low + r4 * r4 * high) * reinterpret_cast<const Lanes&>(power);
}

__attribute__((always_inline)) inline double largest(const Lanes& v) {
  return std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
}

__attribute__((always_inline)) inline double sum(const Lanes& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

// The last lanes of a row may be its own for a part only.
__attribute__((always_inline)) inline void load(const double* row, int left, Lanes& v) {
  constexpr double nothing = -1e300;
  if (left >= lanes)
    v = SEAM_CONST_LANES(row);
  else
    v = Lanes{row[0], left > 1 ? row[1] : nothing, left > 2 ? row[2] : nothing, nothing};
}

__attribute__((always_inline)) inline void store(const Lanes& v, int left, double* row) {
  if (left >= lanes) {
    SEAM_LANES(row) = v;
    return;
  }
  row[0] = v[0];
  if (left > 1) row[1] = v[1];
  if (left > 2) row[2] = v[2];
}

// From exponents of ψ to scale·ψ/Σψ, several rows of M side by side.
template <int rows_count>
__attribute__((always_inline)) inline void normalise(const double (&scale)[rows_count], int M,
                                                     double* rows) {
  Lanes v;
  Lanes top[rows_count];
  for (Lanes& lane : top) lane = Lanes{} - 1e300;
  for (int j = 0; j < M; j += lanes)
    for (int i = 0; i < rows_count; ++i) {
      load(rows + i * M + j, M - j, v);
      top[i] = v > top[i] ? v : top[i];
    }
  double shift[rows_count];
  for (int i = 0; i < rows_count; ++i) shift[i] = largest(top[i]);
  Lanes total[rows_count] = {};
  for (int j = 0; j < M; j += lanes)
    for (int i = 0; i < rows_count; ++i) {
      load(rows + i * M + j, M - j, v);
      v -= shift[i];
      exp_nonpositive(v);
      store(v, M - j, rows + i * M + j);
      total[i] += v;
    }
  double factor[rows_count];
  for (int i = 0; i < rows_count; ++i) factor[i] = scale[i] / sum(total[i]);
  for (int j = 0; j < M; ++j)
    for (int i = 0; i < rows_count; ++i) rows[i * M + j] *= factor[i];
}

template <int rows_count>
__attribute__((always_inline)) inline void discrete(const double* centers, const double* precision,
                                                    int M, const double (&phases)[rows_count],
                                                    double* rows) {
  for (int j = 0; j < M; j += lanes)
    for (int i = 0; i < rows_count; ++i) {
      const Lanes distance = phases[i] - SEAM_CONST_LANES(centers + j);
      store(-(distance * distance) * SEAM_CONST_LANES(precision + j), M - j, rows + i * M + j);
    }
  normalise(phases, M, rows);
}

template <int rows_count>
__attribute__((always_inline)) inline void rhythmic(const double* cosines, const double* sines,
                                                    const double* precision, int M,
                                                    const double (&phases)[rows_count],
                                                    double* rows) {
  double ones[rows_count];
  for (int i = 0; i < rows_count; ++i) {
    const double c = std::cos(phases[i]);
    const double s = std::sin(phases[i]);
    for (int j = 0; j < M; j += lanes) {
      const Lanes cosine = c * SEAM_CONST_LANES(cosines + j) + s * SEAM_CONST_LANES(sines + j);
      store((cosine - 1.0) * SEAM_CONST_LANES(precision + j), M - j, rows + i * M + j);
    }
    ones[i] = 1.0;
  }
  normalise(ones, M, rows);
}

SEAM_WIDEST_VECTORS void discrete_row(const double* centers, const double* precision, int M,
                                      double phase, double* row) noexcept {
  discrete(centers, precision, M, {phase}, row);
}

SEAM_WIDEST_VECTORS void discrete_rows(const double* centers, const double* precision, int M,
                                       double first, double second, double* rows) noexcept {
  discrete(centers, precision, M, {first, second}, rows);
}

SEAM_WIDEST_VECTORS void rhythmic_row(const double* cosines, const double* sines,
                                      const double* precision, int M, double phase,
                                      double* row) noexcept {
  rhythmic(cosines, sines, precision, M, {phase}, row);
}

SEAM_WIDEST_VECTORS void rhythmic_rows(const double* cosines, const double* sines,
                                       const double* precision, int M, double first, double second,
                                       double* rows) noexcept {
  rhythmic(cosines, sines, precision, M, {first, second}, rows);
}

// Room for the last lanes.
Eigen::ArrayXd padded_array(const Eigen::ArrayXd& values) {
  Eigen::ArrayXd longer = Eigen::ArrayXd::Zero(padded(static_cast<int>(values.size())));
  longer.head(values.size()) = values;
  return longer;
}

}  // namespace

Basis::Basis(const Primitive& primitive)
    : kind_(primitive.kind),
      alpha_(primitive.alpha),
      count_(primitive.kernels.count()),
      centers_(padded_array(primitive.kernels.centers.array())),
      precision_(padded_array(0.5 / primitive.kernels.widths.array().square())),
      cosines_(centers_.cos()),
      sines_(centers_.sin()) {}

double Basis::advance(double phase, double t, double tau) const noexcept {
  return kind_ == Kind::discrete ? phase * std::exp(-alpha_ * t / tau) : phase + t / tau;
}

double Basis::time_to(double later, double phase, double tau) const noexcept {
  return kind_ == Kind::discrete ? tau / alpha_ * std::log(phase / later) : tau * (later - phase);
}

double Basis::next(double value, double phase) const noexcept {
  constexpr double turn = 2.0 * M_PI;
  if (kind_ == Kind::discrete) return value;
  const double after = value + turn * (std::floor((phase - value) / turn) + 1.0);
  return after > phase + 1e-9 ? after : after + turn;
}

double Basis::phase_rate(double phase, double tau) const noexcept {
  return kind_ == Kind::discrete ? -alpha_ * phase / tau : 1.0 / tau;
}

void Basis::regressor(double phase, double* row) const noexcept {
  if (kind_ == Kind::discrete)
    discrete_row(centers_.data(), precision_.data(), count(), phase, row);
  else
    rhythmic_row(cosines_.data(), sines_.data(), precision_.data(), count(), phase, row);
}

void Basis::regressors(double first, double second, double* rows) const noexcept {
  if (kind_ == Kind::discrete)
    discrete_rows(centers_.data(), precision_.data(), count(), first, second, rows);
  else
    rhythmic_rows(cosines_.data(), sines_.data(), precision_.data(), count(), first, second, rows);
}

// With ψ' = hψ and n = ψ/Σψ: n' = n(h − Σhn), and a = s·n.
void Basis::slope(double phase, const double* row, double* slope) const noexcept {
  const double s =
      kind_ == Kind::discrete ? std::max(phase, std::numeric_limits<double>::min()) : 1.0;
  const auto h = [&](int j) {
    return kind_ == Kind::discrete
               ? -2.0 * precision_[j] * (phase - centers_[j])
               : precision_[j] * (std::cos(phase) * sines_[j] - std::sin(phase) * cosines_[j]);
  };
  double mean = 0.0;
  for (int j = 0; j < count(); ++j) mean += h(j) * row[j] / s;
  for (int j = 0; j < count(); ++j)
    slope[j] = row[j] * (h(j) - mean) + (kind_ == Kind::discrete ? row[j] / s : 0.0);
}

}  // namespace seam
