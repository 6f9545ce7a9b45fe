#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// A CSV file with a header: named columns of numbers.
struct Table {
  std::vector<std::string> columns;  // C names, all different
  Eigen::MatrixXd values;            // N × C

  /// Reads comma-separated numbers; blanks around them, a final newline and CR LF are allowed. At most 1 GiB.
  /// @throws Error  names file, line and column: unreadable or empty file, no rows, an empty or repeated
  ///                column name, too few or too many fields, a field that is not a finite number
  static Table read(const std::string& path);
  /// Writes 17 significant digits, so that reading gives the same bits. The file appears whole or
  /// not at all.
  /// @throws Error  cannot be written
  void write(const std::string& path) const;
};

}  // namespace seam
