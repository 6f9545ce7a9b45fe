#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/replay.hpp"
#include "scenes/scene.hpp"
#include <seam/join.hpp>
#include <seam/metrics.hpp>
#include <seam/recording.hpp>

namespace seam {

/// One scene played with one method, and what was measured on it.
struct Run {
  Join method = Join::dmp2;
  Recording recording;
  Replay replay;
  RunMetrics metrics;
  double real_time_factor = 0.0;  // simulated time over wall time; not the same twice
};

/// One scene played with several methods.
struct Comparison {
  Scene scene;
  std::vector<Run> runs;
};

/// Its title, with the arm unless that is ideal.
std::string title_on_arm(const Scene& scene);

/// Called after each of the `total` plays has ended, from one thread at a time.
using Progress = std::function<void(int done, int total, const std::string& what)>;

/// Plays every scene with every method at its dt, and until the last join at dt/2 (for the order of the torque jump), on several
/// threads; the results do not depend on how many.
/// @param jobs  threads, ≥ 1
/// @throws Error  see play
std::vector<Comparison> compare(const std::vector<Scene>& scenes, const std::vector<Join>& methods,
                                int jobs, const Progress& progress);

}  // namespace seam
