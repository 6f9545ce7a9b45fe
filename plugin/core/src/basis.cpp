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
SEAM_INLINE void exp_nonpositive(Lanes& y) {
  const Lanes floor = Lanes{} - 700.0;
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

// The kernels at one phase or several.
template <int phases>
struct Discrete {
  const double *centers, *precision;
  double x[phases];

  SEAM_INLINE void exponents(int j, int i, Lanes& v) const {
    const Lanes distance = x[i] - SEAM_CONST_LANES(centers + j);
    v = -(distance * distance) * SEAM_CONST_LANES(precision + j);
  }
  SEAM_INLINE double scale(int i) const { return x[i]; }
};

template <int phases>
struct Rhythmic {
  const double *cosines, *sines, *precision;
  double cosine[phases], sine[phases];

  SEAM_INLINE void exponents(int j, int i, Lanes& v) const {
    v = (cosine[i] * SEAM_CONST_LANES(cosines + j) + sine[i] * SEAM_CONST_LANES(sines + j) - 1.0) *
        SEAM_CONST_LANES(precision + j);
  }
  SEAM_INLINE double scale(int) const { return 1.0; }
};

// Shows a visitor ψ at every phase, four kernels at a time, and sums it up.
template <int phases, class Family, class Visit>
SEAM_INLINE void visit_relative(const Family& family, int M, const double (&to)[phases],
                                Visit visit, double (&sum)[phases]) {
  Lanes total[phases] = {};
  visit.clear();
  for (int j = 0; j < M; j += lanes) {
    Lanes psi[phases];
    for (int i = 0; i < phases; ++i) {
      family.exponents(j, i, psi[i]);
      psi[i] -= to[i];
      exp_nonpositive(psi[i]);
      total[i] += psi[i];
    }
    visit.add(j, psi);
  }
  for (int i = 0; i < phases; ++i)
    sum[i] = (total[i][0] + total[i][1]) + (total[i][2] + total[i][3]);
}

template <class Family>
SEAM_INLINE double largest_exponent(const Family& family, int M, int i) {
  Lanes top = Lanes{} - std::numeric_limits<double>::max();
  for (int j = 0; j < M; j += lanes) {
    Lanes exponents;
    family.exponents(j, i, exponents);
    top = exponents > top ? exponents : top;
  }
  return std::max(std::max(top[0], top[1]), std::max(top[2], top[3]));
}

// Where Σψ nearly vanishes, ψ is taken relative to the largest.
template <int phases, class Family, class Visit>
SEAM_INLINE void visit_kernels(const Family& family, int M, Visit visit, double (&factor)[phases]) {
  double shift[phases] = {};
  double sum[phases];
  visit_relative(family, M, shift, visit, sum);
  if (!(*std::min_element(sum, sum + phases) >= least_sum)) {
    for (int i = 0; i < phases; ++i) shift[i] = largest_exponent(family, M, i);
    visit_relative(family, M, shift, visit, sum);
  }
  for (int i = 0; i < phases; ++i) factor[i] = family.scale(i) / sum[i];
}

// ψ as a row.
struct Row {
  double* row;
  int M;

  SEAM_INLINE void clear() const {}
  SEAM_INLINE void add(int j, const Lanes (&psi)[1]) const {
    for (int l = 0; l < lanes; ++l)
      if (j + l < M) row[j + l] = psi[0][l];
  }
};

// Σψw at two phases, four coordinates at a time.
struct WeightedSums {
  const double* weights;
  int stride;
  double* sums[2];

  SEAM_INLINE void clear() const {
    for (double* sum : sums)
      for (int d = 0; d < stride; d += lanes) SEAM_LANES(sum + d) = Lanes{};
  }
  SEAM_INLINE void add(int j, const Lanes (&psi)[2]) const {
    for (int d = 0; d < stride; d += lanes) {
      const double* w = weights + j * stride + d;
      for (int i = 0; i < 2; ++i)
        SEAM_LANES(sums[i] + d) +=
            (psi[i][0] * SEAM_CONST_LANES(w) + psi[i][1] * SEAM_CONST_LANES(w + stride)) +
            (psi[i][2] * SEAM_CONST_LANES(w + 2 * stride) +
             psi[i][3] * SEAM_CONST_LANES(w + 3 * stride));
    }
  }
  SEAM_INLINE void scale(const double (&factor)[2]) const {
    for (int i = 0; i < 2; ++i)
      for (int d = 0; d < stride; d += lanes) SEAM_LANES(sums[i] + d) *= factor[i];
  }
};

template <class Family>
SEAM_INLINE void fill(const Family& family, const Row& row) {
  double factor[1];
  visit_kernels(family, row.M, row, factor);
  for (int j = 0; j < row.M; ++j) row.row[j] *= factor[0];
}

template <class Family>
SEAM_INLINE void sum_up(const Family& family, int M, const WeightedSums& f) {
  double factor[2];
  visit_kernels(family, M, f, factor);
  f.scale(factor);
}

SEAM_WIDEST_VECTORS void fill_row(const Discrete<1>& family, const Row& row) noexcept {
  fill(family, row);
}
SEAM_WIDEST_VECTORS void fill_row(const Rhythmic<1>& family, const Row& row) noexcept {
  fill(family, row);
}
SEAM_WIDEST_VECTORS void add_up(const Discrete<2>& family, int M, const WeightedSums& f) noexcept {
  sum_up(family, M, f);
}
SEAM_WIDEST_VECTORS void add_up(const Rhythmic<2>& family, int M, const WeightedSums& f) noexcept {
  sum_up(family, M, f);
}

}  // namespace

Basis::Basis(const Primitive& primitive)
    : kind_(primitive.kind),
      alpha_(primitive.alpha),
      count_(primitive.kernels.count()),
      kernels_(padded(count_), columns) {
  kernels_.rowwise() = Eigen::Array4d(2.0, nothing, 0.0, 0.0).transpose();
  const Eigen::ArrayXd centers = primitive.kernels.centers.array();
  kernels_.topRows(count_) << centers, 0.5 / primitive.kernels.widths.array().square(),
      centers.cos(), centers.sin();
}

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
    fill_row(Discrete<1>{at(center), at(precision), {phase}}, {row, count_});
  else
    fill_row(Rhythmic<1>{at(cosine), at(sine), at(precision), {std::cos(phase)}, {std::sin(phase)}},
             {row, count_});
}

void Basis::forcing(double first, double second, const double* weights, int stride, double* f_first,
                    double* f_second) const noexcept {
  const WeightedSums sums{weights, stride, {f_first, f_second}};
  if (kind_ == Kind::discrete)
    add_up(Discrete<2>{at(center), at(precision), {first, second}}, count_, sums);
  else
    add_up(Rhythmic<2>{at(cosine),
                       at(sine),
                       at(precision),
                       {std::cos(first), std::cos(second)},
                       {std::sin(first), std::sin(second)}},
           count_, sums);
}

// With ψ' = hψ and n = ψ/Σψ: n' = n(h − Σhn), and a = s·n.
void Basis::slope(double phase, const double* row, double* slope) const noexcept {
  const double s =
      kind_ == Kind::discrete ? std::max(phase, std::numeric_limits<double>::min()) : 1.0;
  const auto h = [&](int j) {
    return kind_ == Kind::discrete ? -2.0 * at(precision)[j] * (phase - at(center)[j])
                                   : at(precision)[j] * (std::cos(phase) * at(sine)[j] -
                                                         std::sin(phase) * at(cosine)[j]);
  };
  double mean = 0.0;
  for (int j = 0; j < count(); ++j) mean += h(j) * row[j] / s;
  for (int j = 0; j < count(); ++j)
    slope[j] = row[j] * (h(j) - mean) + (kind_ == Kind::discrete ? row[j] / s : 0.0);
}

}  // namespace seam
