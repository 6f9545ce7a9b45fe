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

bool stands(const Eigen::VectorXd& c, const Eigen::VectorXd& v, Eigen::Index joint) {
  return v(joint) == 0.0 && c(joint) > 0.0;
}

}  // namespace

StickSlip::StickSlip(Eigen::Index joints)
    : sliding_(joints, joints), factors_(joints), minimum_(joints) {}

void StickSlip::solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& r, const Eigen::VectorXd& c,
                      Eigen::VectorXd& v) noexcept {
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    for (Eigen::Index i = 0; i < v.size(); ++i)
      v(i) = towards_zero(r(i) - A.row(i).dot(v) + A(i, i) * v(i), c(i)) / A(i, i);
    while (!slide_on(A, r, c, v)) {
    }
    if (all_stick_that_stand(A, r, c, v)) return;
  }
}

// To the minimum with these signs, or to where the first joint on the way there comes to a stand.
bool StickSlip::slide_on(const Eigen::MatrixXd& A, const Eigen::VectorXd& r,
                         const Eigen::VectorXd& c, Eigen::VectorXd& v) noexcept {
  sliding_ = A;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    minimum_(i) = stands(c, v, i) ? 0.0 : r(i) - (v(i) == 0.0 ? 0.0 : std::copysign(c(i), v(i)));
    if (!stands(c, v, i)) continue;
    sliding_.row(i).setZero();
    sliding_.col(i).setZero();
    sliding_(i, i) = 1.0;
  }
  factors_.compute(sliding_);
  factors_.solveInPlace(minimum_);
  double share = 1.0;
  Eigen::Index first = -1;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (c(i) == 0.0 || minimum_(i) * v(i) >= 0.0) continue;
    const double until = v(i) / (v(i) - minimum_(i));
    if (until < share) share = until, first = i;
  }
  if (first < 0) {
    v = minimum_;
    return true;
  }
  v += share * (minimum_ - v);
  v(first) = 0.0;
  return false;
}

bool StickSlip::all_stick_that_stand(const Eigen::MatrixXd& A, const Eigen::VectorXd& r,
                                     const Eigen::VectorXd& c,
                                     const Eigen::VectorXd& v) const noexcept {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (stands(c, v, i) && std::abs(r(i) - A.row(i).dot(v)) > c(i) * (1.0 + rounding)) return false;
  return true;
}

}  // namespace seam
