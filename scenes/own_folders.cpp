#include "scenes/own_folders.hpp"

#include <filesystem>

#include <seam/error.hpp>

namespace seam {

namespace {

namespace fs = std::filesystem;

std::string find_own_folder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = (program.parent_path() / SEAM_SHARE_FROM_PROGRAM).lexically_normal();
  for (const fs::path& folder : {installed, fs::path(SEAM_SOURCE_TREE)})
    if (!folder.empty() && fs::is_directory(folder / "scenes", ignored)) return folder.string();
  throw Error(installed.string(), "is not there, it holds seam's own scenes and assets");
}

}  // namespace

const std::string& own_folder() {
  static const std::string folder = find_own_folder();
  return folder;
}

std::string own_or_given(const std::string& path) {
  std::error_code ignored;
  const fs::path own = fs::path(own_folder()) / path;
  return fs::exists(path, ignored) || !fs::exists(own, ignored) ? path : own.string();
}

std::vector<std::string> with_own_folders(std::vector<std::string> folders) {
  folders.insert(folders.end(), {own_folder() + "/scenes", own_folder() + "/assets"});
  return folders;
}

}  // namespace seam
