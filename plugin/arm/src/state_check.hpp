#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace seam {

/// Whether there is neither NaN nor infinity in them. What is finite but overflows in a sum counts as infinite.
inline bool finite(const Eigen::VectorXd& values) {
  return std::isfinite(values.sum());
}

/// Whether two vectors of one size hold the same numbers.
inline bool same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::equal(a.begin(), a.end(), b.begin());
}

}  // namespace seam
