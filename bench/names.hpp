#pragma once

#include <string>
#include <vector>

#include <seam/join.hpp>

namespace seam {

/// The file of a scene that is named on the command line: a file, or the name of one of the project's own.
std::string scene_file(const std::string& scene);

/// Joining methods by their names; all of them where there are none. @throws Error  an unknown name
std::vector<Join> read_methods(const std::vector<std::string>& names);

}  // namespace seam
