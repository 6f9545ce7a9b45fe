#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// How derivatives are taken from sampled positions: from the quintic spline s on even knots that
/// minimises
///     Σ Δtᵢ (yᵢ − s(tᵢ))² + (2πf_c)⁻⁶ ∫ (d³s/dt³)² dt
/// with Δtᵢ the time that a sample stands for, so that the strength is a cut-off frequency whatever
/// the sampling: a sinusoid of frequency f passes with the factor 1/(1 + (f/f_c)⁶) and without
/// delay. Quadratics pass unchanged, to the very ends. The ends are the weak place: there the fit
/// knows one side alone. Of a minimum-jerk movement that lasts 6/f_c or more, sampled from its
/// first instant to its last, the acceleration at the ends is right to 11 % of the peak, the
/// velocity to 1 %.
struct DerivativeSettings {
  /// f_c [Hz]. 6 Hz is usual for the movements of a hand; tremor (8–12 Hz) is damped 7 to 65 times.
  /// Above half the mean sample rate it is taken as that.
  double cutoff = 6.0;
};

/// A movement as it was shown: N samples of D coordinates at times that need not be even.
struct Demonstration {
  std::vector<std::string> coordinates;  // D names
  Eigen::VectorXd time;                  // [s] N, strictly increasing
  Eigen::MatrixXd position;              // N × D [rad or m]
  Eigen::MatrixXd velocity;              // N × D, per second
  Eigen::MatrixXd acceleration;          // N × D, per second squared
  std::string source = "demonstration";  // where it is from (a file's path), for messages
  /// q₀ of the coordinates rx ry rz (see with_rotation_vector), where it is known.
  std::optional<Eigen::Quaterniond> reference_orientation = std::nullopt;

  int samples() const { return static_cast<int>(time.size()); }         // N
  int dimensions() const { return static_cast<int>(position.cols()); }  // D
  double duration() const { return time(time.size() - 1) - time(0); }   // [s]

  /// Takes derivatives from the positions by a smoothing fit. The positions stay as they are.
  /// @throws Error  fewer than five samples, sizes that do not match, a time that does not
  ///                increase, a value that is not finite, a position or duration that no primitive
  ///                may have (value_bounds, tau_bounds), a cut-off that is not > 0
  static Demonstration from_positions(std::vector<std::string> coordinates, Eigen::VectorXd time,
                                      Eigen::MatrixXd position,
                                      const DerivativeSettings& settings = {});

  /// Reads a CSV file with a header: `time` [s] first, then one column per coordinate c. Where it
  /// has columns `vel.c` and `acc.c` (each for all coordinates or for none, in any order) they are
  /// taken as they are; what is missing comes from the smoothing fit: velocities from that of the
  /// positions, accelerations from that of the velocities where there are any, else of the
  /// positions.
  /// @throws Error  names the file, the line and the column
  static Demonstration read(const std::string& path, const DerivativeSettings& settings = {});

  /// The same movement at even times: duration·rate samples, to the nearest whole number, from the
  /// first to the last. Between samples each column is a cubic with the slopes of the next (of the
  /// parabola through three samples for the accelerations).
  /// @param rate  [1/s]
  /// @throws Error  a rate that is not > 0 or leaves fewer than five samples
  Demonstration resample(double rate) const;

  /// @throws Error  what keeps it from being learned: no coordinates, names that repeat, fewer than
  ///                five samples, sizes that do not match, a time that does not increase, a value
  ///                that is not finite, a position or duration out of bounds, a reference
  ///                orientation that will not do (see require_reference)
  void validate() const;
  /// For a robot to check that it has what was shown.
  /// @throws Error  a coordinate that is not among the names
  void require_coordinates(const std::vector<std::string>& names) const;
};

}  // namespace seam
