#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/join.hpp>

namespace SEAM_API seam {

/// An offset of n joints' reference that fades: from a position d₀, a velocity ḋ₀ and an acceleration d̈₀ to rest at 0, with
/// s = t/T, by the polynomial of fifth order
///     d = d₀(1 − 10s³ + 15s⁴ − 6s⁵) + ḋ₀T(s − 6s³ + 8s⁴ − 3s⁵) + ½d̈₀T²(s² − 3s³ + 3s⁴ − s⁵)
/// Neither allocates nor throws after construction.
class FadingOffset {
 public:
  static constexpr double duration = 1.0;  // [s] T

  /// Of n joints, faded.
  explicit FadingOffset(int joints) : start_(joints), now_(joints) {}

  /// Begins now with an offset [rad or m] and its velocity, at no acceleration.
  void start(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity) noexcept;
  /// Begins anew from the present offset, its acceleration included, and this one together.
  void shift(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity) noexcept;
  void advance(double dt) noexcept;                          // [s]
  bool faded() const noexcept { return time_ >= duration; }  // there is none any more
  /// Adds the present offset to a reference.
  void add_to(Sample& reference) const noexcept;

 private:
  void restart() noexcept;

  Sample start_;            // n, at its beginning
  Sample now_;              // n, workspace
  double time_ = duration;  // [s] since then
};

}  // namespace seam
