#pragma once

#include <seam/export.hpp>

namespace SEAM_API seam {

/// The quintic that leads from 1 to 0 while s goes from 0 to 1, at rest and without acceleration at both ends (minimum jerk;
/// Flash and Hogan 1985): 1 − (10s³ − 15s⁴ + 6s⁵).
inline double fade(double s) {
  return 1.0 - s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}
/// Its first derivative in s.
inline double fade_slope(double s) {
  return -30.0 * s * s * (1.0 - s) * (1.0 - s);
}
/// Its second derivative in s.
inline double fade_curvature(double s) {
  return -60.0 * s * (1.0 - s) * (1.0 - 2.0 * s);
}

}  // namespace seam
