#pragma once

#include <Eigen/Core>

#include <seam/export.hpp>
#include <seam/join.hpp>

namespace SEAM_API seam {

/// An offset of n joints' reference that fades: d(s) from a position d₀ and a velocity ḋ₀ to rest at 0, with s = t/T, by the
/// polynomial of fifth order whose acceleration is 0 at both ends,
///     d = d₀(1 − 10s³ + 15s⁴ − 6s⁵) + ḋ₀T(s − 6s³ + 8s⁴ − 3s⁵)
/// Neither allocates nor throws after construction.
class FadingOffset {
 public:
  static constexpr double duration = 1.0;  // [s] T

  explicit FadingOffset(int joints)
      : position_(Eigen::VectorXd::Zero(joints)), velocity_(position_) {}

  /// Begins now with an offset [rad or m] and its velocity.
  void start(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity) noexcept;
  void advance(double dt) noexcept;  // [s]
  bool faded() const noexcept { return time_ >= duration; }
  /// Adds the present offset to a reference.
  void add_to(Sample& reference) const noexcept;

 private:
  Eigen::VectorXd position_, velocity_;  // n, at its beginning
  double time_ = duration;               // [s] since then
};

}  // namespace seam
