#pragma once

#include <string>
#include <vector>

namespace seam {

/// The folder that holds seam's own `scenes`, `assets`, `bench/baselines` and `bench/experiments`: `share/seam` of the tree that the
/// running program is installed in, wherever that was moved; else the source tree that it was built from.
/// @throws Error  neither is there
const std::string& own_folder();

/// What a command line names: `path` if it is there, else that path within own_folder() if that is there, else `path`.
std::string own_or_given(const std::string& path);

/// Folders and seam's own scenes and assets, which any scene, sequence or experiment may name.
std::vector<std::string> with_own_folders(std::vector<std::string> folders);

}  // namespace seam
