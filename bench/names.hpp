#pragma once

#include <string>
#include <vector>

#include <seam/join.hpp>

namespace seam {

/// Files that are named on the command line: as they are, or as a name or path of one of seam's own (own_folder()); all of
/// those where none is named.
std::string scene_file(const std::string& scene);
std::vector<std::string> scene_files(const std::vector<std::string>& scenes);
std::vector<std::string> experiment_files(const std::vector<std::string>& experiments);

/// Joining methods by their names; all of them where there are none. @throws Error  an unknown name, or one twice
std::vector<Join> read_methods(const std::vector<std::string>& names);

}  // namespace seam
