#pragma once

#include <vector>

#include <Eigen/Core>

namespace seam {

/// min ‖A·W − F‖ for rows that come one after the other, in one pass and a few kilobytes:
/// Householder reflections reduce them, a block at a time, onto the triangle R of A = QR and onto
/// QᵀF.
class LeastSquares {
 public:
  /// @param unknowns  M, columns of A
  /// @param targets   D, columns of F
  LeastSquares(int unknowns, int targets);
  LeastSquares(const LeastSquares&) = delete;
  LeastSquares& operator=(const LeastSquares&) = delete;

  /// Where the next row goes: M values of A and behind them D of F.
  double* next_row();

  /// W, M × D. Where A has not full rank, the W of least norm.
  Eigen::MatrixXd solution();
  /// Largest over smallest singular value of A.
  double condition();
  /// ‖A·W − F‖² for the best W, summed over all columns.
  double residual();

 private:
  void eliminate(int k, double* top, double* rows);
  void reduce();
  Eigen::MatrixXd triangle() const;

  int unknowns_, targets_, stride_;
  int rows_ = 0;             // below the triangle
  Eigen::ArrayXd residual_;  // D
  std::vector<double> storage_;
  double* block_;  // in storage_: the triangle's M rows and those below it
  std::vector<double> column_;
};

}  // namespace seam
