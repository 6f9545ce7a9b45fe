#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// Gains of the transformation system (Eqs. 1 and 5). Stability needs K, D, H > 0.
struct Gains {
  double K = 200.0;                   // stiffness
  double D = 2.0 * std::sqrt(200.0);  // damping
  double H = std::sqrt(200.0);        // goal filter of the third-order system

  /// Critical damping with a triple pole: D = 2√K, H = √K.
  static Gains critical(double K) { return {K, 2.0 * std::sqrt(K), std::sqrt(K)}; }
  /// Table I of the paper, which rounds D and H (poles -14 ± 2i).
  static Gains paper() { return {200.0, 28.0, 14.0}; }
};

/// Whether a movement leads to a goal or repeats.
enum class Kind { discrete, rhythmic };

/// Kernels over the phase: centres cⱼ and widths σⱼ.
///     discrete  ψⱼ(x) = exp(−(x − cⱼ)²/2σⱼ²)             (Eq. 3)
///     rhythmic  ψⱼ(φ) = exp((cos(φ − cⱼ) − 1)/2σⱼ²)      (Eq. 10)
struct Kernels {
  Eigen::VectorXd centers;  // cⱼ: in (0, 1] if discrete, [rad] if rhythmic
  Eigen::VectorXd widths;   // σⱼ > 0

  int count() const { return static_cast<int>(centers.size()); }  // M

  /// Discrete: centres even in time, cⱼ = exp(−α(j − 1)/(M − 1)), and widths σⱼ = width·|cⱼ₊₁ − cⱼ|
  /// (the last repeats the one before). The paper's σ = 0.5 is read as such a multiple of the distance
  /// between neighbours: as an absolute width it leaves a matrix of condition 3·10¹³.
  /// @throws Error  count < 2, width ≤ 0, alpha ≤ 0
  static Kernels even_in_time(int count, double width, double alpha);
  /// Rhythmic: centres 2π(j − 1)/M, all widths σ = width·2π/M.
  /// @throws Error  count < 2, width ≤ 0
  static Kernels even_in_phase(int count, double width);
};

/// What a primitive's numbers must lie within, so that all it is played to stays finite: generous,
/// the usual ones are in the middle.
struct Bounds {
  double least;    // allowed
  double largest;  // allowed

  /// Whether a value is within them; a NaN is not.
  bool hold(double value) const { return value >= least && value <= largest; }
};

inline constexpr Bounds tau_bounds{1e-6, 1e9};      // [s]
inline constexpr Bounds gain_bounds{1e-6, 1e6};     // K, D and H; at K = 1e6 within τ/100
inline constexpr Bounds alpha_bounds{1e-6, 20.0};   // x(τ) from 1 to 2e-9
inline constexpr Bounds center_bounds{-1e6, 1e6};   // phase, [rad] if rhythmic
inline constexpr Bounds width_bounds{1e-9, 1e9};    // likewise
inline constexpr Bounds value_bounds{-1e30, 1e30};  // weights, goal and start, SI units

/// A dynamic movement primitive for D coordinates on one phase: what was learned, as a value.
///     τv̇ = K(r − y) − Dv + f,  τẏ = v,  τṙ = H(g − r)          (Eqs. 1, 5)
///     discrete  f(x) = x·Σwⱼψⱼ(x)/Σψⱼ(x),  τẋ = −αx             (Eqs. 2, 4)
///     rhythmic  f(φ) = A·Σwⱼψⱼ(φ)/Σψⱼ(φ),  τφ̇ = 1               (Eqs. 9, 11)
/// The second-order system is the same with r = g throughout. A rhythmic primitive of period T has
/// τ = T/2π; its goal is the centre about which it moves; its amplitude A is 1 as learned.
struct Primitive {
  Kind kind = Kind::discrete;            // of the phase and the forcing
  std::vector<std::string> coordinates;  // D names
  Gains gains;                           // K, D, H
  double alpha = 2.0;                    // decay of the discrete phase
  Kernels kernels;                       // M
  Eigen::MatrixXd weights;               // M × D
  Eigen::VectorXd goal;                  // D
  double tau = 1.0;                      // [s] time constant: a demonstration's duration, or T/2π
  Eigen::VectorXd start_position;        // D, where the demonstration began
  Eigen::VectorXd start_velocity;        // D, per second
  Eigen::VectorXd start_acceleration;    // D, per second squared
  /// q₀ of the coordinates rx ry rz (see orientation.hpp), where it is known.
  std::optional<Eigen::Quaterniond> reference_orientation = std::nullopt;

  int dimensions() const { return static_cast<int>(goal.size()); }  // D
  /// The same movement, faster by a factor > 0.
  Primitive at_speed(double factor) const;

  /// @throws Error  names the first entry that cannot be executed: sizes that do not match, values
  ///                that are not finite or out of the bounds above, coordinate names that repeat, a
  ///                reference orientation that will not do (see require_reference)
  void validate() const;
};

}  // namespace seam
