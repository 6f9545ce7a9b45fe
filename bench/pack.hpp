#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace seam {

/// Matrices of numbers, small enough for a page: each column in steps of a resolution, the differences from row to row
/// zigzag-coded in 32 bits, their bytes in four planes (lowest first) of columns × rows; all matrices one zlib stream.
class Pack {
 public:
  /// @param values  N × C, finite
  /// @param step    > 0, the resolution; with it the range of a column is below 2³¹ steps
  /// @return        how to find it: {"at": byte, "rows", "columns", "zero", "step"}
  nlohmann::ordered_json add(const Eigen::MatrixXd& values, double step);
  /// The same with a resolution for each column: a 2²⁰th of its range, but not below 1e-9, neither of its largest value
  /// nor of the unit. "zero" and "step" are lists then.
  nlohmann::ordered_json add(const Eigen::MatrixXd& values);

  /// The stream as base64.
  std::string text() const;

 private:
  void append(const Eigen::MatrixXd& values, const Eigen::VectorXd& zero,
              const Eigen::VectorXd& step);

  std::vector<unsigned char> bytes_;
};

}  // namespace seam
