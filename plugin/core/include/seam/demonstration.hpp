#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace seam {

/// How derivatives are taken from sampled positions.
struct DerivativeSettings {
  double window = 0.05;  // [s] half width of the fit around each sample; more is smoother
};

/// A movement as it was shown: N samples of D coordinates at times that need not be even.
struct Demonstration {
  std::vector<std::string> coordinates;  // D names
  Eigen::VectorXd time;                  // [s] N, strictly increasing
  Eigen::MatrixXd position;              // N × D [rad or m]
  Eigen::MatrixXd velocity;              // N × D, per second
  Eigen::MatrixXd acceleration;          // N × D, per second squared

  int samples() const { return static_cast<int>(time.size()); }
  double duration() const { return time(time.size() - 1) - time(0); }  // [s]

  /// Takes derivatives from the positions: around each sample a cubic is fitted by least squares to
  /// all samples within `window` (to the nearest five where there are fewer, one-sided at the
  /// ends). Exact for cubics, at even and uneven times.
  /// @throws Error  fewer than five samples, sizes that do not match, a time that does not
  /// increase,
  ///                a value that is not finite
  static Demonstration from_positions(std::vector<std::string> coordinates, Eigen::VectorXd time,
                                      Eigen::MatrixXd position,
                                      const DerivativeSettings& settings = {});

  /// Reads a CSV file with a header: `time` [s] first, then one column per coordinate.
  /// @throws Error  names the file, line and column
  static Demonstration read(const std::string& path, const DerivativeSettings& settings = {});
};

}  // namespace seam
