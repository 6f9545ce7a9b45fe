#pragma once

#include <Eigen/Core>

#include <seam/primitive.hpp>

namespace seam {

/// One step of length dt of the linear part of Eq. 5, exact for a forcing that is a quadratic over
/// the step. With e = (y − g, ẏ, r − g) and forcing f₀, f_m, f₁ at the start, middle and end:
///     e(dt) = Φ·e(0) + Γ·(f₀, f_m, f₁)ᵀ
/// Φ and Γ come from one matrix exponential (Van Loan), so no dt is unstable and the error of a
/// whole motion is of order dt⁴, from the quadratic alone.
struct Propagator {
  Eigen::Matrix3d Phi = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d Gamma = Eigen::Matrix3d::Zero();

  Propagator() = default;
  Propagator(const Gains& gains, double tau, double dt) noexcept;
};

}  // namespace seam
