#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/primitive.hpp>

namespace SEAM_API seam {

/// The canonical system and the kernels of a primitive, ready for evaluation in a hot path. The phase p
/// is x or φ; with s = x (discrete) or 1 (rhythmic) the regressor is
///     aⱼ(p) = s·ψⱼ(p)/Σψ(p),  so that f = aᵀw     (Eqs. 2, 9; a row of A in Eq. 15)
/// Exponents are taken relative to the largest, so that Σψ never vanishes however far p is from all
/// centres. Evaluation neither allocates nor throws.
class Basis {
 public:
  /// Takes a primitive that is valid.
  explicit Basis(const Primitive& primitive);

  Kind kind() const noexcept { return kind_; }   // of the phase
  int count() const noexcept { return count_; }  // M kernels
  /// x = 1 or φ = 0.
  double start_phase() const noexcept { return kind_ == Kind::discrete ? 1.0 : 0.0; }
  /// The phase a time t [s] after it was `phase`, in closed form: x·exp(−αt/τ) (Eq. 4) or φ + t/τ (Eq. 11).
  double advance(double phase, double t, double tau) const noexcept;
  /// Time [s] from a phase until another: x falls, φ rises; negative where it has passed.
  double time_to(double later, double phase, double tau) const noexcept;
  /// The phase at which a value comes next: x itself, or the φ + 2πn that follows.
  double next(double value, double phase) const noexcept;
  /// dp/dt.
  double phase_rate(double phase, double tau) const noexcept;

  /// a(p); count() values.
  void regressor(double phase, double* row) const noexcept;
  /// f = aᵀW at two phases at once. W is row-major, its rows and its columns (`stride` of them, as many values of
  /// f at each phase) filled up with zeros to a multiple of four.
  void forcing(double first, double second, const double* weights, int stride, double* f_first,
               double* f_second) const noexcept;
  /// da/dp at the phase for which a(p) is `row`; count() values.
  void slope(double phase, const double* row, double* slope) const noexcept;

 private:
  Kind kind_;
  double alpha_;
  int count_;
  // Columns, filled up to a multiple of four by kernels that vanish.
  enum Column {
    center,
    precision,  // 1/2σ²
    cosine,     // of the centre
    sine,
    columns
  };
  const double* at(Column column) const noexcept { return kernels_.col(column).data(); }
  Eigen::ArrayXXd kernels_;
};

}  // namespace seam
