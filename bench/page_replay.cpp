#include "bench/page_replay.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <seam/mesh.hpp>

namespace seam {

namespace {

using Json = nlohmann::ordered_json;

constexpr double mesh_step = 2.5e-4;  // [m]
constexpr double normal_step = 0.25;  // of a unit vector: what keeps the two sides of an edge apart
constexpr double pose_step = 1e-4;    // [m], and of a quaternion
constexpr double finest_step = 1e-5;  // [m] of waves

struct Piece {
  Eigen::MatrixXd positions;  // V × 3 [m]
  Eigen::MatrixXd triangles;  // T × 3
};

// Vertices that fall together, in the order in which the triangles need them.
Piece simplified(const Mesh& mesh) {
  std::map<std::array<long, 6>, int> seen;
  std::vector<Eigen::Vector3d> positions;
  const auto vertex = [&](int v) {
    std::array<long, 6> key{};
    for (int i = 0; i < 3; ++i) {
      key[static_cast<std::size_t>(i)] = std::lround(mesh.positions(i, v) / mesh_step);
      key[static_cast<std::size_t>(i + 3)] = std::lround(mesh.normals(i, v) / normal_step);
    }
    const auto [found, is_new] = seen.emplace(key, static_cast<int>(positions.size()));
    if (is_new) positions.push_back(mesh.positions.col(v).cast<double>());
    return found->second;
  };
  std::vector<Eigen::Vector3d> triangles;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Eigen::Vector3i corners = mesh.triangles.col(t).unaryExpr(vertex);
    if (corners(0) != corners(1) && corners(1) != corners(2) && corners(2) != corners(0))
      triangles.emplace_back(corners.cast<double>());
  }
  const auto rows = [](const std::vector<Eigen::Vector3d>& list) {
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(list.size()), 3);
    for (std::size_t i = 0; i < list.size(); ++i)
      matrix.row(static_cast<Eigen::Index>(i)) = list[i].transpose();
    return matrix;
  };
  return {rows(positions), rows(triangles)};
}

Json pose(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  Json list = Json::array();
  for (const double value : X.translation()) list.push_back(value);
  for (const double value : q.coeffs()) list.push_back(value);
  return list;
}

template <typename Vector>
Json numbers(const Vector& values) {
  Json list = Json::array();
  for (const auto value : values) list.push_back(value);
  return list;
}

Json visual_page(const Geometry& visual, PageMeshes& meshes) {
  static constexpr const char* types[] = {"box", "cylinder", "sphere", "mesh"};
  Json page = {{"type", types[static_cast<std::size_t>(visual.type)]},
               {"pose", pose(visual.X_body_shape)}};
  if (visual.type == Geometry::Type::mesh) {
    page["meshes"] = meshes.pieces(visual.mesh);
    page["scale"] = numbers(visual.scale);
  } else {
    page["size"] = numbers(visual.size);
  }
  const bool own_colour = visual.type == Geometry::Type::mesh && !visual.has_colour;
  page["colour"] = own_colour ? Json() : numbers(visual.colour);
  return page;
}

Json part_page(const Replay::Part& part, PageMeshes& meshes) {
  Json page = {{"name", part.name}, {"visuals", Json::array()}};
  for (const Geometry& visual : part.visuals)
    page["visuals"].push_back(visual_page(visual, meshes));
  if (part.vessel)
    page["vessel"] = {{"radius", part.vessel->radius},
                      {"height", part.vessel->height},
                      {"wall", part.vessel->wall}};
  return page;
}

}  // namespace

const std::vector<int>& PageMeshes::pieces(const std::string& path) {
  const auto known = files_.find(path);
  if (known != files_.end()) return known->second;
  std::vector<int> numbers_of_file;
  for (const Mesh& mesh : load_mesh(path)) {
    const Piece piece = simplified(mesh);
    if (piece.triangles.rows() == 0) continue;
    numbers_of_file.push_back(static_cast<int>(meshes_.size()));
    meshes_.push_back({{"positions", pack_.add(piece.positions, mesh_step)},
                       {"triangles", pack_.add(piece.triangles, 1.0)},
                       {"colour", numbers(mesh.colour)}});
  }
  return files_[path] = std::move(numbers_of_file);
}

Json PageMeshes::page() const {
  return {{"pack", pack_.text()}, {"meshes", meshes_}};
}

Json page_stage(const Replay& replay, PageMeshes& meshes) {
  Json parts = Json::array();
  for (const Replay::Part& part : replay.parts) parts.push_back(part_page(part, meshes));
  Json stage = {
      {"frame_rate", replay.frame_rate}, {"parts", parts}, {"primitives", replay.primitives}};
  if (replay.grains) stage["grain_radius"] = replay.grains->radius;
  if (replay.liquid)
    stage["liquid"] = {{"part", replay.liquid->part},
                       {"radius", replay.liquid->radius},
                       {"depth", replay.liquid->depth}};
  return stage;
}

Json page_camera(const Camera& camera) {
  return {{"from", numbers(camera.from)}, {"at", numbers(camera.at)}};
}

Json page_motion(const Replay& replay, Pack& pack) {
  const auto add = [&](const Replay::Track& track, double step) {
    return pack.add(track.cast<double>(), step);
  };
  Json motion = {{"poses", add(replay.poses, pose_step)},
                 {"tool", add(replay.tool, pose_step)},
                 {"running", replay.running}};
  if (replay.grains) motion["grains"] = add(replay.grains->positions, pose_step);
  if (replay.liquid) motion["waves"] = add(replay.liquid->waves, finest_step);
  return motion;
}

}  // namespace seam
