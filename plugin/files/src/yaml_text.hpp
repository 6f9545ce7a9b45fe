#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace seam {

/// Pieces of YAML text, readable by YAML 1.1 and 1.2 alike.
/// 17 significant digits, so that reading gives the same bits.
std::string yaml_number(double value);
/// In double quotes, with escapes.
std::string yaml_text(const std::string& text);
/// [a, b, …]
std::string yaml_list(const Eigen::VectorXd& values);
std::string yaml_list(const std::vector<std::string>& texts);
/// A line `reference: [x, y, z, w]`; none where there is no reference orientation.
std::string yaml_reference(const std::optional<Eigen::Quaterniond>& reference);

}  // namespace seam
