#pragma once

#include <seam/export.hpp>

namespace SEAM_API seam {

/// A sum of many small terms, such as a time that steps add up to, that does not drift: what an addition rounds off
/// is kept and added with the next (Kahan). After n terms the error is of one rounding, not of n.
class CompensatedSum {
 public:
  /// Begins with a value.
  CompensatedSum(double value = 0.0) noexcept
      : value_(value) {}  // NOLINT(google-explicit-constructor)

  /// Adds a term.
  CompensatedSum& operator+=(double term) noexcept {
    const double whole = term - excess_;
    const double next = value_ + whole;
    excess_ = (next - value_) - whole;
    value_ = next;
    return *this;
  }
  /// The sum so far.
  operator double() const noexcept { return value_; }  // NOLINT(google-explicit-constructor)

 private:
  double value_;
  double excess_ = 0.0;  // by which value_ is too large
};

}  // namespace seam
