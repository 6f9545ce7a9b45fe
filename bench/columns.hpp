#pragma once

#include <functional>
#include <map>
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

/// Those of a recording: one in task space has more, and each scene what came of it.
std::vector<Column> columns(const Recording& recording);

/// The same for the figures of one join.
struct JoinColumn {
  std::string name;
  std::string heading;
  std::string format;
  double JoinMetrics::*of;
};

std::vector<JoinColumn> join_columns(const Recording& recording);

/// The figures of a run by the names of its columns.
std::map<std::string, double> figures(const Run& run);

/// One thing that came of a run, for people: `spilled`, `0.425 %`.
struct ShownOutcome {
  std::string name;
  std::string value;  // with its unit
};
std::vector<ShownOutcome> shown_outcomes(const Recording& recording);

/// The comparison as a Markdown table, a method a column, that is aligned for reading on a terminal.
std::string table(const Comparison& comparison);
/// All scenes and methods in one table: what came of each, and what it cost; a scene's arms stand in one row.
/// @param comparisons  those of a scene side by side, the ideal arm first
std::string overview(const std::vector<Comparison>& comparisons);

}  // namespace seam
