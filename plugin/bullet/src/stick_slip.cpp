#include "stick_slip.hpp"

#include <algorithm>
#include <cmath>

namespace seam {

namespace {

constexpr int most_sweeps = 100;
constexpr double rounding = 1e-12;

double towards_zero(double value, double by) {
  return std::copysign(std::max(std::abs(value) - by, 0.0), value);
}

}  // namespace

StickSlip::StickSlip(Eigen::Index joints)
    : sliding_(joints, joints), factors_(joints), found_(joints) {}

void StickSlip::solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& r, const Eigen::VectorXd& c,
                      Eigen::VectorXd& v) noexcept {
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    for (Eigen::Index i = 0; i < v.size(); ++i)
      v(i) = towards_zero(r(i) - A.row(i).dot(v) + A(i, i) * v(i), c(i)) / A(i, i);
    if (solve_with_signs(A, r, c, v)) return;
  }
}

bool StickSlip::solve_with_signs(const Eigen::MatrixXd& A, const Eigen::VectorXd& r,
                                 const Eigen::VectorXd& c, Eigen::VectorXd& v) noexcept {
  const auto sticks = [&](Eigen::Index i) { return v(i) == 0.0 && c(i) > 0.0; };
  sliding_ = A;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    found_(i) = sticks(i) ? 0.0 : r(i) - (v(i) == 0.0 ? 0.0 : std::copysign(c(i), v(i)));
    if (!sticks(i)) continue;
    sliding_.row(i).setZero();
    sliding_.col(i).setZero();
    sliding_(i, i) = 1.0;
  }
  factors_.compute(sliding_);
  factors_.solveInPlace(found_);
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (sticks(i)) {
      if (std::abs(r(i) - A.row(i).dot(found_)) > c(i) * (1.0 + rounding)) return false;
    } else if (c(i) > 0.0 && found_(i) * v(i) < 0.0) {
      return false;
    }
  }
  v = found_;
  return true;
}

}  // namespace seam
