#pragma once

#include <cmath>

#include "tests/support.hpp"

namespace seam::test {

/// Minimum jerk with a wiggle, 0.4·(4s(1 − s))³·sin 3πs: the movement behind many figures.
inline Demonstration wiggle(int samples = 1001) {
  const auto bump = [](double s, int order) {
    const double w = 3.0 * M_PI;
    const double p = s * s * s * (1.0 + s * (-3.0 + s * (3.0 - s)));
    const double p1 = s * s * (3.0 + s * (-12.0 + s * (15.0 - 6.0 * s)));
    const double p2 = s * (6.0 + s * (-36.0 + s * (60.0 - 30.0 * s)));
    if (order == 0) return p * std::sin(w * s);
    if (order == 1) return p1 * std::sin(w * s) + w * p * std::cos(w * s);
    return (p2 - w * w * p) * std::sin(w * s) + 2.0 * w * p1 * std::cos(w * s);
  };
  Demonstration demo = minimum_jerk().resample(samples - 1);
  for (int i = 0; i < samples; ++i) {
    const double s = demo.time(i);
    demo.position(i, 0) = s * s * s * (10.0 + s * (-15.0 + 6.0 * s)) + 25.6 * bump(s, 0);
    demo.velocity(i, 0) = 30.0 * s * s * (1.0 - s) * (1.0 - s) + 25.6 * bump(s, 1);
    demo.acceleration(i, 0) = 60.0 * s * (1.0 + s * (-3.0 + 2.0 * s)) + 25.6 * bump(s, 2);
  }
  return demo;
}

}  // namespace seam::test
