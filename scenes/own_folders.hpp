#pragma once

#include <string>
#include <vector>

namespace seam {

/// The folder that holds seam's own `scenes`, `assets`, `bench/baselines` and `bench/experiments`: `share/seam` of the tree that the
/// running program is installed in, wherever that was moved; else the source tree that it was built from.
/// @throws Error  neither is there
const std::string& own_folder();
/// Says where that is, before it is first asked for: in a module of Python the running program is Python.
void set_own_folder(const std::string& folder);

/// What a command line names: `path` if it is there, else that path within own_folder() if that is there, else `path`.
std::string own_or_given(const std::string& path);

/// Folders and seam's own scenes and assets, which any scene, sequence or experiment may name.
std::vector<std::string> with_own_folders(std::vector<std::string> folders);

/// Files that are named by a user: as they are, or as a name or path of one of seam's own (own_folder()); all of
/// those where none is named.
std::string scene_file(const std::string& scene);
std::vector<std::string> scene_files(const std::vector<std::string>& scenes);
std::vector<std::string> experiment_files(const std::vector<std::string>& experiments);

}  // namespace seam
