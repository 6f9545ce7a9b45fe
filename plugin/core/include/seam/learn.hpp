#pragma once

#include <seam/demonstration.hpp>
#include <seam/primitive.hpp>

namespace seam {

struct LearnSettings {
  int kernels = 10;     // M
  double width = 0.75;  // kernel width as a multiple of the distance between neighbouring centres
  double alpha = 2.0;   // decay of the phase; x(τ) = exp(−alpha)
  Gains gains;
};

/// Weights that reproduce a demonstration, by least squares over all kernels at once (Eqs. 13, 15),
/// solved by a rank-revealing orthogonal decomposition. The target is Eq. 12 with r = g, so that
/// second- and third-order systems share the weights:
///     f*(t) = τ²ÿ + τDẏ + K(y − g)
/// @param demo  N samples × D coordinates; N ≥ 2·kernels
/// @return      primitive with weights M × D, its goal the last sample, its tau the demonstration's
/// duration [s]
/// @throws Error  fewer samples than 2·kernels, sizes that do not match, settings out of range
Primitive learn(const Demonstration& demo, const LearnSettings& settings = {});

}  // namespace seam
