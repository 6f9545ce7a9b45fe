#pragma once

#include <string>
#include <vector>

#include <seam/join.hpp>

namespace seam {

/// Joining methods by their names; all of them where there are none. @throws Error  an unknown name, or one twice
std::vector<Join> read_methods(const std::vector<std::string>& names);

}  // namespace seam
