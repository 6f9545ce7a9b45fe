#pragma once

#include <string>
#include <vector>

#include "bench/compare.hpp"

namespace seam {

/// Writes what a bench leaves behind: for each scene DIR/SCENE/METHOD.csv (SCENE: see on_arm), its replay, METHOD.replay.json, and the pictures (see
/// draw_figures); the tables as DIR/table.md; and at last DIR/summary.json. Each file is whole or not there; older ones are
/// replaced one by one, and a summary.json or report.html that was there goes first, so that none stands beside what it does not
/// tell of. The same runs give the same bytes: wall-clock figures are not in these files.
/// @param jobs  threads, ≥ 1
/// @throws Error  cannot be written, or gnuplot fails
void write_results(const std::vector<Comparison>& comparisons, const std::string& seam_version,
                   const std::string& dir, int jobs);

}  // namespace seam
