#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <seam/demonstration.hpp>

/// Minimum jerk from one place to another in a time [s], sampled at 100 Hz as if it had been shown.
inline seam::Demonstration movement(std::vector<std::string> coordinates,
                                    const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                    double seconds) {
  const auto samples = static_cast<Eigen::Index>(std::lround(100.0 * seconds)) + 1;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(samples, 0.0, seconds);
  Eigen::MatrixXd position(samples, from.size());
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double s = time(i) / seconds;
    position.row(i) = from + s * s * s * (10.0 + s * (6.0 * s - 15.0)) * (to - from);
  }
  return seam::Demonstration::from_positions(std::move(coordinates), time, position);
}
