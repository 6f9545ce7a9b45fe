#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/pack.hpp"
#include "scenes/replay.hpp"

namespace seam {

/// The mesh files that replays show, each once for the whole page: vertices that agree to a quarter of a millimetre are
/// one, and what has no area then is left out.
class PageMeshes {
 public:
  /// Its pieces, each of one colour, by their numbers. @throws Error  see load_mesh
  const std::vector<int>& pieces(const std::string& path);

  /// {"pack", "meshes": [{"positions", "triangles", "colour"}]}
  nlohmann::ordered_json page() const;

 private:
  Pack pack_;
  nlohmann::ordered_json meshes_ = nlohmann::ordered_json::array();
  std::map<std::string, std::vector<int>> files_;
};

/// What the replays of a scene have in common: its parts and names.
/// @throws Error  a mesh cannot be read
nlohmann::ordered_json page_stage(const Replay& replay, PageMeshes& meshes);

nlohmann::ordered_json page_camera(const Camera& camera);

/// Where everything was: to 0.1 mm, and 1e-4 of a quaternion.
nlohmann::ordered_json page_motion(const Replay& replay, Pack& pack);

}  // namespace seam
