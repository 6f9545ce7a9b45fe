#include "bench/names.hpp"

#include <filesystem>

namespace seam {

std::string scene_file(const std::string& scene) {
  if (std::filesystem::is_regular_file(scene) || scene.find_first_of("./") != std::string::npos)
    return scene;
  return std::string(SEAM_SCENES) + "/" + scene + ".yaml";
}

std::vector<Join> read_methods(const std::vector<std::string>& names) {
  std::vector<Join> methods;
  for (const std::string& name : names) methods.push_back(join_from_name(name));
  if (names.empty()) methods.assign(all_joins.begin(), all_joins.end());
  return methods;
}

}  // namespace seam
