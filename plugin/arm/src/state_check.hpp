#pragma once

#include <cmath>

#include <Eigen/Core>

namespace seam {

/// Whether a state has neither NaN nor infinity in it.
inline bool finite(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  return std::isfinite(q.sum() + qd.sum());
}

/// Whether two vectors of one size hold the same numbers.
inline bool same(const Eigen::Ref<const Eigen::VectorXd>& a,
                 const Eigen::Ref<const Eigen::VectorXd>& b) {
  return (a.array() == b.array()).all();
}

}  // namespace seam
