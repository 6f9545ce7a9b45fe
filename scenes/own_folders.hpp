#pragma once

#include <string>
#include <vector>

namespace seam {

/// Folders and seam's own scenes and assets, which any scene, sequence or experiment may name.
std::vector<std::string> with_own_folders(std::vector<std::string> folders);

}  // namespace seam
