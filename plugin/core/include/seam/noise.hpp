#pragma once

#include <cstdint>
#include <random>

#include <seam/export.hpp>

namespace SEAM_API seam {

/// Normally distributed noise of standard deviation 1, the same bits on every platform: the sum of twelve even numbers
/// in [0, 1), less 6, which lies within ±6.
class Noise {
 public:
  /// The same seed gives the same numbers.
  explicit Noise(int seed) : random_(static_cast<std::uint64_t>(seed)) {}

  /// The next number.
  double normal() noexcept {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_() >> 11) * 0x1p-53;
    return sum;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace seam
