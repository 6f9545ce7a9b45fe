#pragma once

#include <string>
#include <vector>

#include "bench/compare.hpp"

namespace seam {

/// One measured figure of a run: its name in summary.json, its heading in the table, and where it
/// is found. A new metric is one new line in `columns()`.
struct Column {
  const char* name;     // with its unit, as in summary.json
  const char* heading;  // as printed
  const char* unit;
  const char* format;  // of fmt
  double (*of)(const Run& run);
};

const std::vector<Column>& columns();

/// The comparison as a Markdown table that is aligned for reading on a terminal.
std::string table(const Comparison& comparison);

}  // namespace seam
