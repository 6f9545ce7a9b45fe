#include "least_squares.hpp"

#include <cmath>
#include <cstdint>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "vectors.hpp"

namespace seam {

namespace {

constexpr int rows_per_block = 64;
constexpr double nothing = 1e-200;  // a sum of squares below this is taken as zero

// Vectors that begin within 32 bytes lie in one line of the cache.
double* aligned(double* storage) {
  constexpr std::uintptr_t size = lanes * sizeof(double);
  const auto beyond = reinterpret_cast<std::uintptr_t>(storage) % size;
  return storage + (beyond ? (size - beyond) / sizeof(double) : 0);
}

// Copies column k of the rows, with zeros to a multiple of four; its sum of squares.
double copy_column(int k, int stride, int count, const double* rows, double* column) noexcept {
  Lanes sum = {};
  for (int i = 0; i < padded(count); ++i) column[i] = i < count ? rows[i * stride + k] : 0.0;
  for (int i = 0; i < count; i += lanes)
    sum += SEAM_CONST_LANES(column + i) * SEAM_CONST_LANES(column + i);
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

// H = I − factor·vvᵀ with v = (head, column), applied to four columns: a row of the triangle's and
// those below. Four sums side by side, as one would wait for itself.
SEAM_WIDEST_VECTORS void reflect(double head, double factor, const double* column, int count,
                                 int stride, double* top, double* rows) noexcept {
  Lanes sum[lanes] = {head * SEAM_LANES(top)};
  for (int i = 0; i < count; i += lanes)
    for (int l = 0; l < lanes; ++l) sum[l] += column[i + l] * SEAM_LANES(rows + (i + l) * stride);
  const Lanes product = factor * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
  SEAM_LANES(top) -= head * product;
  for (int i = 0; i < count; ++i) SEAM_LANES(rows + i * stride) -= column[i] * product;
}

}  // namespace

LeastSquares::LeastSquares(int unknowns, int targets)
    : unknowns_(unknowns),
      targets_(targets),
      stride_(padded(unknowns + targets)),
      residual_(Eigen::ArrayXd::Zero(targets)),
      storage_(static_cast<std::size_t>(stride_ * (unknowns + rows_per_block) + lanes)),
      block_(aligned(storage_.data())),
      column_(rows_per_block) {}

double* LeastSquares::next_row() {
  if (rows_ == rows_per_block) reduce();
  return block_ + stride_ * (unknowns_ + rows_++);
}

// Reflects column k of the rows onto the triangle's diagonal, and all columns to the right with it.
void LeastSquares::eliminate(int k, double* top, double* rows) {
  double* column = column_.data();
  const double below = copy_column(k, stride_, rows_, rows, column);
  if (below < nothing) return;
  const double norm = std::sqrt(top[k] * top[k] + below);
  const double diagonal = top[k] > 0.0 ? -norm : norm;
  const double head = top[k] - diagonal;
  const double factor = 2.0 / (head * head + below);
  for (int c = k / lanes * lanes; c < stride_; c += lanes)
    reflect(head, factor, column, padded(rows_), stride_, top + c, rows + c);
  top[k] = diagonal;
}

void LeastSquares::reduce() {
  double* rows = block_ + stride_ * unknowns_;
  for (int k = 0; k < unknowns_; ++k) eliminate(k, block_ + stride_ * k, rows);
  for (int i = 0; i < rows_; ++i)
    residual_ +=
        Eigen::Map<const Eigen::ArrayXd>(rows + i * stride_ + unknowns_, targets_).square();
  rows_ = 0;
}

Eigen::MatrixXd LeastSquares::triangle() const {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> top(block_, unknowns_, stride_);
  return top.leftCols(unknowns_).triangularView<Eigen::Upper>();
}

Eigen::MatrixXd LeastSquares::solution() {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  reduce();
  const Eigen::Map<const Rows> top(block_, unknowns_, stride_);
  return triangle().completeOrthogonalDecomposition().solve(top.middleCols(unknowns_, targets_));
}

double LeastSquares::condition() {
  reduce();
  const Eigen::VectorXd values = triangle().jacobiSvd().singularValues();
  return values(0) / values(unknowns_ - 1);
}

double LeastSquares::residual() {
  reduce();
  return residual_.sum();
}

}  // namespace seam
