#pragma once

#include <seam/demonstration.hpp>
#include <seam/export.hpp>
#include <seam/primitive.hpp>

namespace SEAM_API seam {

/// How the weights follow from A (Eq. 15) and f* (Eq. 12).
enum class LearnMethod {
  /// Over all kernels at once (Eqs. 13, 15), by an orthogonal decomposition of A.
  least_squares,
  /// The same sample by sample (Eqs. 16, 17): see RecursiveLearner.
  recursive,
  /// Each kernel by itself (Eq. 14): wⱼ = Σψⱼ s f* / Σψⱼ s², s = x or 1. Kernels that overlap all
  /// do the same work: the worst fit, with 16 times the error of f* of the others at width 0.75.
  locally_weighted,
};

/// How a primitive is learned; the defaults are the paper's, its widths read as multiples of the distance.
struct LearnSettings {
  Kind kind = Kind::discrete;  // of the primitive
  int kernels = 0;             // M; 0: 10 if discrete, 20 if rhythmic
  /// Multiple of the distance between kernels; 0: 0.75 if discrete, 0.32·20/2π if rhythmic.
  double width = 0.0;
  double alpha = 2.0;   // decay of the discrete phase; x(τ) = exp(−alpha)
  double period = 0.0;  // [s] of a rhythmic movement; 0: found (see find_period)
  LearnMethod method = LearnMethod::least_squares;  // for the weights
  /// [m or rad] > 0: the smallest number of kernels that reproduces the demonstration to this
  /// (LearnReport::error_max), with the best of the widths 0.5, 0.75, 1.0 and 1.5; `kernels` is
  /// then the most that are tried (0: 100) and `width`, unless 0, the only width. Each trial takes
  /// one learning and one roll-out.
  double precision = 0.0;
  Gains gains;  // of the primitive
};

/// Learns from a demonstration. The target is Eq. 12 with r = g, so that second- and third-order
/// systems share the weights:
///     f*(t) = τ²ÿ + τDẏ + K(y − g)
/// A discrete primitive has the last sample as its goal and the duration as its τ. A rhythmic one
/// has τ = T/2π, phase 0 at the first sample, and as its goal the centre (see find_centre); the
/// demonstration may hold any number of periods from one on, whole or not.
/// @param demo  N samples × D coordinates; N ≥ 2·kernels
/// @return      primitive with weights M × D, its reference orientation the demonstration's
/// @throws Error  names the demonstration's source: fewer samples than 2·kernels, a demonstration
///                that is not valid, settings out of range, no period found or less than one shown,
///                a precision that is not reached (with the best that was)
Primitive learn(const Demonstration& demo, const LearnSettings& settings = {});

/// How well a primitive does what was shown.
struct LearnReport {
  double forcing_error;  // RMS of f* − f over RMS of f*, over all coordinates
  double condition;      // of A, largest over smallest singular value
  double error_max;      // [m or rad] of the positions when rolled out from the first sample's
  double error_rms;      // state, over all coordinates
};

/// Compares a primitive with a demonstration of the same coordinates, its own or another that has
/// the same start and time. Rolls out the second-order system.
/// @throws Error  either is not valid, coordinates or reference orientations that differ
LearnReport assess(const Demonstration& demo, const Primitive& primitive);

}  // namespace seam
