#include <algorithm>
#include <cmath>
#include <limits>

#include "vectors.hpp"
#include <seam/basis.hpp>

namespace seam {

namespace {

constexpr double nothing = 1e300;  // the precision of a kernel that only fills up
constexpr double least_phase = 1e-200;
constexpr double least_sum = 1e-200;  // of ψ; below it exponents are taken from the largest

// exp(y) for y ≤ 0 to the last bit or two; flat below −700.
// y = n·ln 2 + r, |r| ≤ ln 2/2, and the Taylor polynomial of degree 13 in r.
SEAM_INLINE void exp_nonpositive(WideLanes& y) {
  const WideLanes floor = WideLanes{} - 700.0;
  const WideLanes clamped = y > floor ? y : floor;
  const WideLanes shifted = clamped * 0x1.71547652b82fep0 + 0x1.8p52;
  const WideLanes n = shifted - 0x1.8p52;
  const WideLanes r = (clamped - n * 0x1.62e42fefa0000p-1) - n * 0x1.cf79abc9e3b3ap-40;
  const WideLanes r2 = r * r;
  const WideLanes r4 = r2 * r2;
  const WideLanes low =
      (1.0 + r) + r2 * (0.5 + r * (1.0 / 6.0)) +
      r4 * ((1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0 + r * (1.0 / 5040.0)));
  const WideLanes high = (1.0 / 40320.0 + r * (1.0 / 362880.0)) +
                         r2 * (1.0 / 3628800.0 + r * (1.0 / 39916800.0)) +
                         r4 * (1.0 / 479001600.0 + r * (1.0 / 6227020800.0));
  const WideIntegers power = (reinterpret_cast<const WideIntegers&>(shifted) + 1023) << 52;
  y = (low + r4 * r4 * high) * reinterpret_cast<const WideLanes&>(power);
}

// Lanes hold four kernels at a first phase, then the same four at a second.
SEAM_INLINE void set_halves(double first, double second, WideLanes& v) {
  v = WideLanes{first, first, first, first, second, second, second, second};
}
SEAM_INLINE void set_twice(const double* four, WideLanes& v) {
  const Lanes& half = SEAM_CONST_LANES(four);
  v = __builtin_shufflevector(half, half, 0, 1, 2, 3, 0, 1, 2, 3);
}

// Exponents of ψ, of the kernels from j on.
struct Discrete {
  const double *centers, *precision;
  double first, second;

  SEAM_INLINE void exponents(int j, WideLanes& v) const {
    WideLanes phases, center, factor;
    set_halves(first, second, phases);
    set_twice(centers + j, center);
    set_twice(precision + j, factor);
    const WideLanes distance = phases - center;
    v = -(distance * distance) * factor;
  }
};

struct Rhythmic {
  const double *cosines, *sines, *precision;
  double cosine[2], sine[2];

  Rhythmic(const double* of_cosines, const double* of_sines, const double* of_precision,
           double first, double second)
      : cosines(of_cosines),
        sines(of_sines),
        precision(of_precision),
        cosine{std::cos(first), std::cos(second)},
        sine{std::sin(first), std::sin(second)} {}

  SEAM_INLINE void exponents(int j, WideLanes& v) const {
    WideLanes c, s, center_c, center_s, factor;
    set_halves(cosine[0], cosine[1], c);
    set_halves(sine[0], sine[1], s);
    set_twice(cosines + j, center_c);
    set_twice(sines + j, center_s);
    set_twice(precision + j, factor);
    v = (c * center_c + s * center_s - 1.0) * factor;
  }
};

// Visits ψ four kernels at a time, and sums it up. Where Σψ nearly vanishes, ψ is taken relative to the largest.
template <class Family, class Visit>
SEAM_INLINE void visit_relative(const Family& family, int M, const WideLanes& to, Visit visit,
                                double (&sum)[2]) {
  WideLanes total{};
  for (int j = 0; j < M; j += lanes) {
    WideLanes psi;
    family.exponents(j, psi);
    psi -= to;
    exp_nonpositive(psi);
    visit.add(j, psi);
    total += psi;
  }
  sum[0] = (total[0] + total[1]) + (total[2] + total[3]);
  sum[1] = (total[4] + total[5]) + (total[6] + total[7]);
}

template <class Family>
SEAM_INLINE void largest_exponents(const Family& family, int M, WideLanes& largest) {
  WideLanes top = WideLanes{} - std::numeric_limits<double>::max();
  for (int j = 0; j < M; j += lanes) {
    WideLanes exponents;
    family.exponents(j, exponents);
    top = exponents > top ? exponents : top;
  }
  set_halves(std::max(std::max(top[0], top[1]), std::max(top[2], top[3])),
             std::max(std::max(top[4], top[5]), std::max(top[6], top[7])), largest);
}

template <class Family, class Visit>
SEAM_INLINE void visit_kernels(const Family& family, int M, Visit visit, double (&sum)[2]) {
  visit.clear();
  visit_relative(family, M, WideLanes{}, visit, sum);
  if (sum[0] >= least_sum && sum[1] >= least_sum) return;
  WideLanes largest;
  largest_exponents(family, M, largest);
  visit.clear();
  visit_relative(family, M, largest, visit, sum);
}

// ψ of the first phase as a row.
struct Row {
  double* row;
  int M;

  SEAM_INLINE void clear() const {}
  SEAM_INLINE void add(int j, const WideLanes& psi) const {
    for (int l = 0; l < lanes; ++l)
      if (j + l < M) row[j + l] = psi[l];
  }
};

// Σψw at both phases, eight coordinates at a time.
struct WeightedSums {
  const double* weights;
  int stride;
  double *first, *second;

  SEAM_INLINE void clear() const {
    for (int d = 0; d < stride; d += wide_lanes)
      SEAM_WIDE(first + d) = SEAM_WIDE(second + d) = WideLanes{};
  }
  SEAM_INLINE void add(int j, const WideLanes& psi) const {
    double p[wide_lanes];
    SEAM_WIDE(p) = psi;
    for (int d = 0; d < stride; d += wide_lanes) {
      const double* w = weights + j * stride + d;
      const WideLanes w0 = SEAM_CONST_WIDE(w);
      const WideLanes w1 = SEAM_CONST_WIDE(w + stride);
      const WideLanes w2 = SEAM_CONST_WIDE(w + 2 * stride);
      const WideLanes w3 = SEAM_CONST_WIDE(w + 3 * stride);
      SEAM_WIDE(first + d) += (p[0] * w0 + p[1] * w1) + (p[2] * w2 + p[3] * w3);
      SEAM_WIDE(second + d) += (p[4] * w0 + p[5] * w1) + (p[6] * w2 + p[7] * w3);
    }
  }
  SEAM_INLINE void scale(double by_first, double by_second) const {
    for (int d = 0; d < stride; d += wide_lanes) {
      SEAM_WIDE(first + d) *= by_first;
      SEAM_WIDE(second + d) *= by_second;
    }
  }
};

template <class Family>
SEAM_INLINE void fill_row(const Family& family, double s, const Row& row) {
  double sum[2];
  visit_kernels(family, row.M, row, sum);
  for (int j = 0; j < row.M; ++j) row.row[j] *= s / sum[0];
}

template <class Family>
SEAM_INLINE void sum_up(const Family& family, int M, double first, double second,
                        const WeightedSums& f) {
  double sum[2];
  visit_kernels(family, M, f, sum);
  f.scale(first / sum[0], second / sum[1]);
}

SEAM_WIDEST_VECTORS void fill_row(const Discrete& family, const Row& row) noexcept {
  fill_row(family, family.first, row);
}
SEAM_WIDEST_VECTORS void fill_row(const Rhythmic& family, const Row& row) noexcept {
  fill_row(family, 1.0, row);
}
SEAM_WIDEST_VECTORS void sum_up(const Discrete& family, int M, const WeightedSums& f) noexcept {
  sum_up(family, M, family.first, family.second, f);
}
SEAM_WIDEST_VECTORS void sum_up(const Rhythmic& family, int M, const WeightedSums& f) noexcept {
  sum_up(family, M, 1.0, 1.0, f);
}

Eigen::ArrayXd filled_up(const Eigen::ArrayXd& values, double by) {
  Eigen::ArrayXd longer = Eigen::ArrayXd::Constant(padded(static_cast<int>(values.size())), by);
  longer.head(values.size()) = values;
  return longer;
}

}  // namespace

Basis::Basis(const Primitive& primitive)
    : kind_(primitive.kind),
      alpha_(primitive.alpha),
      count_(primitive.kernels.count()),
      centers_(filled_up(primitive.kernels.centers.array(), 2.0)),
      precision_(filled_up(0.5 / primitive.kernels.widths.array().square(), nothing)),
      cosines_(filled_up(primitive.kernels.centers.array().cos(), 0.0)),
      sines_(filled_up(primitive.kernels.centers.array().sin(), 0.0)) {}

double Basis::advance(double phase, double t, double tau) const noexcept {
  if (kind_ == Kind::rhythmic) return phase + t / tau;
  return std::max(phase * std::exp(-alpha_ * t / tau), least_phase);
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
    fill_row(Discrete{centers_.data(), precision_.data(), phase, phase}, {row, count_});
  else
    fill_row(Rhythmic(cosines_.data(), sines_.data(), precision_.data(), phase, phase),
             {row, count_});
}

void Basis::forcing(double first, double second, const double* weights, int stride, double* f_first,
                    double* f_second) const noexcept {
  const WeightedSums sums{weights, stride, f_first, f_second};
  if (kind_ == Kind::discrete)
    sum_up(Discrete{centers_.data(), precision_.data(), first, second}, count_, sums);
  else
    sum_up(Rhythmic(cosines_.data(), sines_.data(), precision_.data(), first, second), count_,
           sums);
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
