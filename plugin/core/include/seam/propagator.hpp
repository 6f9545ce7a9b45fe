#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/primitive.hpp>

namespace SEAM_API seam {

/// One step of length dt of the linear system
///     τ²ÿ = K(g − y) − Dτẏ + f + e,   ë = −2λė − λ²e,   λ = H/τ
/// exact for a forcing f that is a quadratic over the step. e dies out critically damped; with ė = −λe it is
/// e₀·exp(−λt), the K(r − g) of Eq. 5. With s = (y − g, ẏ, e, ė) and f₀, f_m, f₁ at the start, middle and end:
///     s(dt) = Φ·s(0) + Γ·(f₀, f_m, f₁)ᵀ
/// Φ and Γ are those of the exponential of the system together with its forcing (Van Loan), from Taylor's series over a part
/// of the step that is doubled until it is whole: no dt is unstable, and the error of a whole motion is of order dt⁴,
/// from the quadratic alone.
struct Propagator {
  Eigen::Matrix4d Phi = Eigen::Matrix4d::Identity();                        // of s
  Eigen::Matrix<double, 2, 3> Gamma = Eigen::Matrix<double, 2, 3>::Zero();  // of y − g and ẏ

  Propagator() = default;
  /// For a step of dt [s] ≥ 0.
  Propagator(const Gains& gains, double tau, double dt) noexcept;
};

}  // namespace seam
