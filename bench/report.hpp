#pragma once

#include <string>
#include <vector>

#include "bench/compare.hpp"

namespace seam {

/// Writes what a bench leaves behind: DIR/summary.json, the tables as DIR/table.md, and for each
/// scene DIR/SCENE/METHOD.csv and its replay, METHOD.replay.json. The same runs give the same bytes: wall-clock figures are not in
/// these files.
/// @throws Error  cannot be written
void write_results(const std::vector<Comparison>& comparisons, const std::string& seam_version,
                   const std::string& dir);

}  // namespace seam
