#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "urdf_elements.hpp"

namespace seam {
namespace {

namespace fs = std::filesystem;

bool starts_with(const std::string& name, const std::string& prefix) {
  return name.compare(0, prefix.size(), prefix) == 0;
}

std::vector<fs::path> split_path_list(const char* list) {
  std::vector<fs::path> folders;
  std::istringstream in(list ? list : "");
  for (std::string folder; std::getline(in, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

fs::path folder_of(const MeshPlaces& places) {
  return fs::absolute(places.urdf).parent_path();
}

/// A folder may hold the package or be it.
void add_package(std::vector<fs::path>& candidates, const fs::path& folder, const fs::path& package,
                 const fs::path& rest) {
  candidates.push_back(folder / package / rest);
  if (folder.filename() == package) candidates.push_back(folder / rest);
}

std::vector<fs::path> package_candidates(const fs::path& name, const MeshPlaces& places) {
  const fs::path package = *name.begin();
  const fs::path rest = name.lexically_relative(package);
  std::vector<fs::path> candidates;
  for (const auto& folder : places.package_path) add_package(candidates, folder, package, rest);
  for (const auto& folder : split_path_list(std::getenv("ROS_PACKAGE_PATH"))) {
    add_package(candidates, folder, package, rest);
  }
  for (fs::path folder = folder_of(places); folder != folder.root_path();
       folder = folder.parent_path()) {
    std::error_code status;
    if (folder.filename() == package) candidates.push_back(folder / rest);
    if (fs::is_directory(folder / package, status)) candidates.push_back(folder / package / rest);
  }
  return candidates;
}

const std::string package = "package://";
const std::string file = "file://";

/// NAME/… of package://NAME/…, which some write with a slash too many.
fs::path in_package(const std::string& name) {
  return fs::path(name.substr(package.size())).relative_path();
}

std::vector<fs::path> mesh_candidates(const std::string& name, const MeshPlaces& places) {
  if (name.empty()) return {};
  if (starts_with(name, package)) {
    const fs::path rest = in_package(name);
    return rest.empty() ? std::vector<fs::path>{} : package_candidates(rest, places);
  }
  if (starts_with(name, file)) return {folder_of(places) / name.substr(file.size())};
  if (name.find("://") != std::string::npos) return {};
  return {folder_of(places) / name};
}

std::string nowhere_to_look(const std::string& name) {
  if (!starts_with(name, package)) return "must be package://, file:// or a path";
  const fs::path rest = in_package(name);
  return "no folder to look in: give one that is or holds package \"" +
         (rest.empty() ? std::string() : rest.begin()->string()) +
         "\" in package_path or ROS_PACKAGE_PATH";
}

}  // namespace

std::string mesh_path(const std::string& name, const MeshPlaces& places, const std::string& where) {
  const std::vector<fs::path> candidates = mesh_candidates(name, places);
  std::string looked;
  for (const auto& candidate : candidates) {
    std::error_code status;
    const fs::path path = fs::absolute(candidate).lexically_normal();
    if (fs::is_regular_file(path, status)) return path.string();
    looked += (looked.empty() ? "" : ", ") + path.string();
  }
  throw MeshNotFound(where, "mesh \"" + name + "\" not found, " +
                                (looked.empty() ? nowhere_to_look(name) : "looked for " + looked));
}

}  // namespace seam
