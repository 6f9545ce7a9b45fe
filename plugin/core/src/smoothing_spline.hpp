#pragma once

#include <Eigen/Core>

namespace seam {

/// The smoothing fit of DerivativeSettings, in time and memory of order N. Six knots to each period
/// of the cut-off; the equations for the B-spline coefficients have eleven diagonals. Without more,
/// the third derivative would be drawn to zero at the ends, where a movement has most of it; so at
/// either end a curve (1 − t/L)⁵ goes free of the penalty, with L = 2/f_c, at most a third of all.
class SmoothingSpline {
 public:
  /// @param time    N ≥ 3, strictly increasing [s]
  /// @param values  N × D
  /// @param cutoff  > 0 [Hz], at most half the mean sample rate is used
  SmoothingSpline(const Eigen::VectorXd& time, const Eigen::MatrixXd& values, double cutoff);

  /// d^order s/dt^order at given times within the fit's; N × D.
  Eigen::MatrixXd derivative(const Eigen::VectorXd& time, int order) const;

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Band = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  struct Place {
    Eigen::Index cell;
    double u;  // 0 to 1 within the cell
  };

  Place place(double t) const;
  void add_samples(const Eigen::VectorXd& time, const Eigen::MatrixXd& values, Band& band);
  void add_penalty(const Matrix6& penalty, Band& band) const;
  void free_ends(const Band& band, const Matrix6& penalty, const Rows& load);

  double begin_;    // [s]
  double spacing_;  // [s] of the knots
  Eigen::Index cells_;
  Rows coefficients_;  // (cells + 5) × D
};

}  // namespace seam
