#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/compare.hpp"

namespace seam {

/// One measured figure of a run: its name in summary.json, its heading in the table, and where it
/// is found. A new metric is one new line in `columns()`.
struct Column {
  std::string name;     // with its unit, as in summary.json
  std::string heading;  // as printed, with the unit
  std::string format;   // of fmt
  std::function<double(const Run& run)> of;
};

/// Those of a comparison: a scene in task space has more, and each scene what came of it.
std::vector<Column> columns(const Comparison& comparison);

/// The comparison as a Markdown table that is aligned for reading on a terminal.
std::string table(const Comparison& comparison);
/// All scenes and methods in one table: what came of each, and what it cost.
std::string overview(const std::vector<Comparison>& comparisons);

}  // namespace seam
