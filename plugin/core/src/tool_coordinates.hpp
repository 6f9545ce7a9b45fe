#pragma once

#include <string>
#include <vector>

namespace seam {

/// Names of a tool's coordinates, which are no joints'.
inline bool are_a_tools(const std::vector<std::string>& names) {
  using Names = std::vector<std::string>;
  return names == Names{"x", "y", "z"} || names == Names{"x", "y", "z", "rx", "ry", "rz"};
}

/// Of a coordinate of which nothing but its name is known.
inline bool is_linear(const std::string& name) {
  return name == "x" || name == "y" || name == "z";
}

}  // namespace seam
