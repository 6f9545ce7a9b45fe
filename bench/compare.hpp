#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scenes/scene.hpp"
#include <seam/join.hpp>
#include <seam/metrics.hpp>
#include <seam/recording.hpp>

namespace seam {

/// One scene played with one method, and what was measured on it.
struct Run {
  Join method = Join::dmp2;
  Recording recording;
  RunMetrics metrics;
  std::vector<double> join_orders;  // of the torque jump at each join
  double torque_jump_order = std::numeric_limits<double>::quiet_NaN();  // of the worst join
  double deviation_peak_rad = 0.0;  // [rad] of the reference from dmp2's
  double deviation_peak_m = 0.0;    // [m] of the tool's, in task space
  double real_time_factor = 0.0;    // simulated time over wall time; not the same twice
};

/// One scene played with several methods.
struct Comparison {
  Scene scene;
  std::vector<Run> runs;
};

/// Called after each of the `total` plays has ended, from one thread at a time.
using Progress = std::function<void(int done, int total, const std::string& what)>;

/// Plays every scene with every method at its dt and at dt/2 (for the order of the torque jump), on
/// several threads; the results do not depend on how many.
/// @param jobs  threads, ≥ 1
/// @throws Error  see play
std::vector<Comparison> compare(const std::vector<Scene>& scenes, const std::vector<Join>& methods,
                                int jobs, const Progress& progress);

}  // namespace seam
