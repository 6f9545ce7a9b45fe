#include "smoothing_spline.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace seam {

namespace {

constexpr int terms = 6;  // of a quintic
constexpr double knots_per_period = 6.0;
constexpr Eigen::Index longest_end = 12;  // cells: two periods of the cut-off
constexpr Eigen::Index least_cells = 6;   // for ends of their own
constexpr double stiffest = 1e5;          // beyond this the fit is a parabola but for rounding

using Vector6 = Eigen::Matrix<double, terms, 1>;
using Matrix6 = Eigen::Matrix<double, terms, terms>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Band = Eigen::Matrix<double, terms, Eigen::Dynamic>;

Eigen::Index reach(Eigen::Index i, Eigen::Index n) {
  return std::min<Eigen::Index>(terms, n - i);
}

// Coefficients of 1, u … u⁵ (columns) of the six pieces (rows) that meet in a cell.
const Matrix6& pieces() {
  static const Matrix6 matrix = [] {
    Matrix6 m;
    m << 1, -5, 10, -10, 5, -1,    //
        26, -50, 20, 20, -20, 5,   //
        66, 0, -60, 0, 30, -10,    //
        26, 50, 20, -20, -20, 10,  //
        1, 5, 10, 10, 5, -5,       //
        0, 0, 0, 0, 0, 1;
    return Matrix6(m / 120.0);
  }();
  return matrix;
}

// Coefficients of the pieces' derivatives.
Matrix6 differentiated(Matrix6 pieces, int times) {
  for (; times > 0; --times) {
    for (int p = 0; p + 1 < terms; ++p) pieces.col(p) = (p + 1) * pieces.col(p + 1);
    pieces.col(terms - 1).setZero();
  }
  return pieces;
}

Vector6 values_at(const Matrix6& pieces, double u) {
  Vector6 value = pieces.col(terms - 1);
  for (int p = terms - 2; p >= 0; --p) value = value * u + pieces.col(p);
  return value;
}

// ∫ of the products of third derivatives over a cell, by Gauss's rule of three points.
Matrix6 cell_penalty() {
  const Matrix6 third = differentiated(pieces(), 3);
  const double offset = 0.5 * std::sqrt(0.6);
  const double nodes[] = {0.5 - offset, 0.5, 0.5 + offset};
  const double weights[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  Matrix6 penalty = Matrix6::Zero();
  for (int g = 0; g < 3; ++g) {
    const Vector6 value = values_at(third, nodes[g]);
    penalty += weights[g] * value * value.transpose();
  }
  return penalty;
}

// Coefficients of (1 − t/L)⁵ within L cells of the left end, and of its mirror image.
Rows end_curves(Eigen::Index L, Eigen::Index count) {
  Rows curves = Rows::Zero(count, 2);
  for (Eigen::Index j = 0; j < L; ++j) {
    double value = 1.0;
    for (Eigen::Index knot = j - 4; knot <= j; ++knot)
      value *= static_cast<double>(L - knot) / static_cast<double>(L);
    curves(j, 0) = curves(count - 1 - j, 1) = value;
  }
  return curves;
}

// Cholesky's decomposition within the band.
void decompose(Band& band) {
  const Eigen::Index n = band.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    band.col(i) /= std::sqrt(band(0, i));
    for (int k = 1; k < reach(i, n); ++k)
      band.col(i + k).head(terms - k) -= band(k, i) * band.col(i).tail(terms - k);
  }
}

void solve(const Band& band, Rows& x) {
  const Eigen::Index n = band.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    x.row(i) /= band(0, i);
    for (int k = 1; k < reach(i, n); ++k) x.row(i + k) -= band(k, i) * x.row(i);
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    for (int k = 1; k < reach(i, n); ++k) x.row(i) -= band(k, i) * x.row(i + k);
    x.row(i) /= band(0, i);
  }
}

}  // namespace

SmoothingSpline::SmoothingSpline(const Eigen::VectorXd& time, const Eigen::MatrixXd& values,
                                 double cutoff)
    : begin_(time(0)) {
  const Eigen::Index N = time.size();
  const double duration = time(N - 1) - begin_;
  const double used = std::min(cutoff, 0.5 * static_cast<double>(N - 1) / duration);
  cells_ = std::max<Eigen::Index>(1, std::lround(knots_per_period * used * duration));
  spacing_ = duration / static_cast<double>(cells_);
  coefficients_.setZero(cells_ + terms - 1, values.cols());
  Band band = Band::Zero(terms, coefficients_.rows());
  add_samples(time, values, band);
  const Matrix6 penalty =
      std::min(std::pow(2.0 * M_PI * used * spacing_, -6.0), stiffest) * cell_penalty();
  add_penalty(penalty, band);
  decompose(band);
  const Rows load = coefficients_;
  solve(band, coefficients_);
  if (cells_ >= least_cells) free_ends(band, penalty, load);
}

SmoothingSpline::Place SmoothingSpline::place(double t) const {
  const double u = (t - begin_) / spacing_;
  const auto cell = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(u), 0, cells_ - 1);
  return {cell, u - static_cast<double>(cell)};
}

// band(k, i) is the element (i, i + k) of the matrix; the right-hand side goes to coefficients_.
void SmoothingSpline::add_samples(const Eigen::VectorXd& time, const Eigen::MatrixXd& values,
                                  Band& band) {
  const Eigen::Index N = time.size();
  const Matrix6& basis = pieces();
  for (Eigen::Index i = 0; i < N; ++i) {
    const Place at = place(time(i));
    const Vector6 b = values_at(basis, at.u);
    const double share =
        0.5 * (time(std::min(i + 1, N - 1)) - time(std::max<Eigen::Index>(i - 1, 0))) / spacing_;
    for (int j = 0; j < terms; ++j) {
      const double weighted = share * b(j);
      for (int k = j; k < terms; ++k) band(k - j, at.cell + j) += weighted * b(k);
      coefficients_.row(at.cell + j) += weighted * values.row(i);
    }
  }
}

void SmoothingSpline::add_penalty(const Matrix6& penalty, Band& band) const {
  for (Eigen::Index cell = 0; cell < cells_; ++cell)
    for (int j = 0; j < terms; ++j)
      band.col(cell + j).head(terms - j) += penalty.col(j).tail(terms - j);
}

// With E the end curves, P the penalty and M the whole matrix: R = M⁻¹PE is what the penalty takes
// from them, and the amounts that minimise the sum of squares and penalty of the rest are added.
void SmoothingSpline::free_ends(const Band& band, const Matrix6& penalty, const Rows& load) {
  const Rows curves = end_curves(std::min(longest_end, cells_ / 3), coefficients_.rows());
  Rows penalised = Rows::Zero(curves.rows(), curves.cols());
  for (Eigen::Index cell = 0; cell < cells_; ++cell)
    penalised.middleRows<terms>(cell) += penalty * curves.middleRows<terms>(cell);
  Rows taken = penalised;
  solve(band, taken);
  const Eigen::Matrix2d normal = penalised.transpose() * (curves - taken);
  coefficients_ += taken * normal.inverse() * (taken.transpose() * load);
}

Eigen::MatrixXd SmoothingSpline::derivative(const Eigen::VectorXd& time, int order) const {
  const Matrix6 basis = differentiated(pieces(), order) / std::pow(spacing_, order);
  Eigen::MatrixXd result(time.size(), coefficients_.cols());
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const Place at = place(time(i));
    const Vector6 b = values_at(basis, at.u);
    result.row(i) = b(0) * coefficients_.row(at.cell);
    for (int j = 1; j < terms; ++j) result.row(i) += b(j) * coefficients_.row(at.cell + j);
  }
  return result;
}

}  // namespace seam
