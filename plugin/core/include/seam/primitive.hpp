#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace seam {

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

/// Gaussian kernels ψⱼ(x) = exp(−(x − cⱼ)²/2σⱼ²) over the discrete phase (Eq. 3).
struct Kernels {
  Eigen::VectorXd centers;  // cⱼ, in (0, 1], falling
  Eigen::VectorXd widths;   // σⱼ > 0

  int count() const { return static_cast<int>(centers.size()); }

  /// Centres even in time, cⱼ = exp(−α(j − 1)/(M − 1)), and widths σⱼ = width·|cⱼ₊₁ − cⱼ| (the last
  /// repeats the one before). The paper's σ = 0.5 is read as such a multiple of the distance
  /// between neighbours: as an absolute width it leaves a matrix of condition 3·10¹³.
  /// @throws Error  count < 2, width ≤ 0, alpha ≤ 0
  static Kernels even_in_time(int count, double width, double alpha);
};

/// A discrete dynamic movement primitive for D coordinates on one phase: what was learned, as a
/// value.
///     τv̇ = K(r − y) − Dv + f(x),  τẏ = v,  τṙ = H(g − r),  τẋ = −αx        (Eqs. 1, 4, 5)
///     f(x) = x·Σwⱼψⱼ(x)/Σψⱼ(x)                                             (Eq. 2)
/// The second-order system is the same with r = g throughout.
struct Primitive {
  std::vector<std::string> coordinates;  // D names
  Gains gains;
  double alpha = 2.0;                  // decay of the phase
  Kernels kernels;                     // M
  Eigen::MatrixXd weights;             // M × D
  Eigen::VectorXd goal;                // D
  double tau = 1.0;                    // [s] time constant; the demonstration's duration
  Eigen::VectorXd start_position;      // D, where the demonstration began
  Eigen::VectorXd start_velocity;      // D, per second
  Eigen::VectorXd start_acceleration;  // D, per second squared

  int dimensions() const { return static_cast<int>(goal.size()); }

  /// @throws Error  names the first entry that cannot be executed: sizes that do not match, values
  /// that
  ///                are not finite, tau, alpha, gains or widths ≤ 0, coordinate names that repeat
  void validate() const;
};

}  // namespace seam
