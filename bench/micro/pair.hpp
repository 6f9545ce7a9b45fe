#pragma once

#include <functional>
#include <string>

namespace seam::micro {

/// Does a piece of work and says how long it took [s].
using Timed = std::function<double()>;
/// Of this thread on the processor: what others do there does not count.
Timed timed(std::function<void()> work);
/// On the wall.
Timed timed_on_the_wall(std::function<void()> work);

/// Two pieces of work that are measured in turn, A B A B …, so that a machine whose speed drifts, or that others use too,
/// slows both alike.
struct Pair {
  Timed work, beside;
  double items = 1.0;                    // of what is measured, in one piece of work: ticks, steps
  std::function<void()> before = [] {};  // each pair; puts things back, is not measured
};

constexpr double no_bar = 0.0;

/// Adds a benchmark. Its counters are the medians of both times per item, the median over the pairs of their ratio, the
/// ratio of the times that a twentieth is faster than, and the bar for either ratio.
/// @param name  "what / beside what"
/// @param make  called when the benchmark is run
void add_pair(const std::string& name, double bar, int pairs, std::function<Pair()> make);

}  // namespace seam::micro
