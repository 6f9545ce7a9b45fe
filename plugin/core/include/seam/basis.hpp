#pragma once

#include <Eigen/Core>

#include <seam/primitive.hpp>

namespace seam {

/// The canonical system and the kernels of a primitive, ready for evaluation in a hot path.
class Basis {
 public:
  Basis(const Kernels& kernels, double alpha);

  int count() const noexcept { return static_cast<int>(centers_.size()); }
  double start_phase() const noexcept { return 1.0; }
  /// The phase a time t after it was `phase`: x·exp(−αt/τ), Eq. 4 in closed form.
  double advance(double phase, double t, double tau) const noexcept {
    return phase * std::exp(-alpha_ * t / tau);
  }
  /// a(x) with f(x) = a(x)ᵀw: aⱼ = x·ψⱼ/Σψ (Eq. 2; a row of A in Eq. 15). Exponents are taken
  /// relative to the largest, so that Σψ never vanishes however far x is from all centres.
  /// @param row  count() values
  void regressor(double phase, Eigen::Ref<Eigen::ArrayXd> row) const noexcept;

 private:
  Eigen::ArrayXd centers_;
  Eigen::ArrayXd precision_;  // 1/2σ²
  double alpha_;
};

}  // namespace seam
