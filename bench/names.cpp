#include "bench/names.hpp"

#include <algorithm>
#include <filesystem>

#include "scenes/own_folders.hpp"
#include <seam/error.hpp>

namespace seam {

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

std::vector<Join> read_methods(const std::vector<std::string>& names) {
  std::vector<Join> methods;
  for (const std::string& name : names) {
    const Join method = join_from_name(name);
    if (std::find(methods.begin(), methods.end(), method) != methods.end())
      throw Error("method \"" + name + "\"", "given twice");
    methods.push_back(method);
  }
  if (names.empty()) methods.assign(all_joins.begin(), all_joins.end());
  return methods;
}

}  // namespace seam
