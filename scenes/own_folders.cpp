#include "scenes/own_folders.hpp"

#include <algorithm>
#include <filesystem>

#include <seam/error.hpp>

namespace seam {

namespace {

namespace fs = std::filesystem;

std::string& set_folder() {
  static std::string folder;
  return folder;
}

std::string find_own_folder() {
  if (!set_folder().empty()) return set_folder();
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = (program.parent_path() / SEAM_SHARE_FROM_PROGRAM).lexically_normal();
  for (const fs::path& folder : {installed, fs::path(SEAM_SOURCE_TREE)})
    if (!folder.empty() && fs::is_directory(folder / "scenes", ignored)) return folder.string();
  throw Error(installed.string(), "is not there, it holds seam's own scenes and assets");
}

}  // namespace

void set_own_folder(const std::string& folder) {
  set_folder() = folder;
}

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

namespace {

std::string file_of(const std::string& name, const std::string& folder) {
  if (std::filesystem::is_regular_file(name) || name.find_first_of("./") != std::string::npos)
    return own_or_given(name);
  return folder + "/" + name + ".yaml";
}

std::vector<std::string> files_of(const std::vector<std::string>& names,
                                  const std::string& folder) {
  std::vector<std::string> files;
  for (const std::string& name : names) files.push_back(file_of(name, folder));
  if (!names.empty()) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string scene_file(const std::string& scene) {
  return file_of(scene, own_folder() + "/scenes");
}

std::vector<std::string> scene_files(const std::vector<std::string>& scenes) {
  return files_of(scenes, own_folder() + "/scenes");
}

std::vector<std::string> experiment_files(const std::vector<std::string>& experiments) {
  return files_of(experiments, own_folder() + "/bench/experiments");
}

}  // namespace seam
