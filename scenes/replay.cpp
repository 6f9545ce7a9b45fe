#include "scenes/replay.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "scenes/base64.hpp"
#include <seam/error.hpp>
#include <seam/whole_file.hpp>

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "tracks are written as they lie in memory");

namespace seam {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* shape_names[] = {"box", "cylinder", "sphere", "mesh"};

template <typename Vector>
Json numbers(const Vector& vector) {
  return Json(std::vector<double>(vector.data(), vector.data() + vector.size()));
}

template <int size>
Eigen::Matrix<double, size, 1> vector_of(const Json& list) {
  const auto values = list.get<std::vector<double>>();
  if (values.size() != size)
    throw Error("list of " + std::to_string(values.size()) + " numbers, must be " +
                std::to_string(size));
  return Eigen::Map<const Eigen::Matrix<double, size, 1>>(values.data());
}

Json pose_numbers(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  Eigen::Matrix<double, 7, 1> pose;
  pose << X.translation(), q.coeffs();
  return numbers(pose);
}

template <typename Vector>
Eigen::Isometry3d pose_of(const Vector& pose) {
  const Eigen::Vector4d turned = pose.template tail<4>().template cast<double>();
  return Eigen::Translation3d(pose.template head<3>().template cast<double>()) *
         Eigen::Quaterniond(turned).normalized();
}

Json to_json(const Geometry& shape) {
  Json json{{"type", shape_names[static_cast<int>(shape.type)]},
            {"pose", pose_numbers(shape.X_body_shape)}};
  if (shape.type == Geometry::Type::mesh) {
    json["mesh"] = std::filesystem::absolute(shape.mesh).lexically_normal().string();
    json["scale"] = numbers(shape.scale);
  } else {
    json["size"] = numbers(shape.size);
  }
  if (shape.has_colour) json["colour"] = numbers(shape.colour);
  return json;
}

Geometry geometry_of(const Json& json, const std::filesystem::path& folder) {
  Geometry shape;
  const auto type = json.at("type").get<std::string>();
  const auto* found = std::find(std::begin(shape_names), std::end(shape_names), type);
  if (found == std::end(shape_names))
    throw Error("shape \"" + type + "\", must be box, cylinder, sphere or mesh");
  shape.type = static_cast<Geometry::Type>(found - std::begin(shape_names));
  shape.X_body_shape = pose_of(vector_of<7>(json.at("pose")));
  if (shape.type == Geometry::Type::mesh) {
    shape.mesh = (folder / json.at("mesh").get<std::string>()).string();
    shape.scale = vector_of<3>(json.at("scale"));
  } else {
    shape.size = vector_of<3>(json.at("size"));
  }
  shape.has_colour = json.contains("colour");
  if (shape.has_colour) shape.colour = vector_of<4>(json.at("colour"));
  return shape;
}

Json to_json(const Replay::Part& part) {
  Json json{{"name", part.name}, {"visuals", Json::array()}};
  for (const Geometry& shape : part.visuals) json["visuals"].push_back(to_json(shape));
  if (part.vessel)
    json["vessel"] = {{"radius", part.vessel->radius},
                      {"height", part.vessel->height},
                      {"wall", part.vessel->wall}};
  return json;
}

Replay::Part part_of(const Json& json, const std::filesystem::path& folder) {
  Replay::Part part;
  part.name = json.at("name").get<std::string>();
  for (const Json& visual : json.at("visuals")) part.visuals.push_back(geometry_of(visual, folder));
  if (!json.contains("vessel")) return part;
  part.vessel.emplace();
  json.at("vessel").at("radius").get_to(part.vessel->radius);
  json.at("vessel").at("height").get_to(part.vessel->height);
  json.at("vessel").at("wall").get_to(part.vessel->wall);
  return part;
}

std::string text_of(const Replay::Track& track) {
  return base64({reinterpret_cast<const char*>(track.data()),
                 static_cast<std::size_t>(track.size()) * sizeof(float)});
}

Replay::Track track_of(const Json& json, const char* key, Eigen::Index columns) {
  const std::string bytes = from_base64(json.at(key).get_ref<const std::string&>());
  const auto row = static_cast<std::size_t>(columns) * sizeof(float);
  if (bytes.size() % row != 0)
    throw Error(std::string(key) + ": " + std::to_string(bytes.size()) +
                " bytes, must be a multiple of " + std::to_string(row));
  Replay::Track track(static_cast<Eigen::Index>(bytes.size() / row), columns);
  std::memcpy(track.data(), bytes.data(), bytes.size());
  if (!track.allFinite()) throw Error(std::string(key) + ": holds a number that is not finite");
  return track;
}

Replay replay_of(const Json& json, const std::filesystem::path& folder) {
  if (json.at("format") != 1) throw Error("format " + json.at("format").dump() + ", must be 1");
  Replay replay;
  json.at("scene").get_to(replay.scene);
  json.at("method").get_to(replay.method);
  json.at("frame_rate").get_to(replay.frame_rate);
  for (const Json& part : json.at("parts")) replay.parts.push_back(part_of(part, folder));
  replay.poses = track_of(json, "frames", 7 * static_cast<Eigen::Index>(replay.parts.size()));
  replay.tool = track_of(json, "tool", 3);
  if (json.contains("grains")) {
    const Json& grains = json.at("grains");
    replay.grains = {grains.at("radius").get<double>(),
                     track_of(grains, "positions", 3 * grains.at("count").get<Eigen::Index>())};
  }
  if (json.contains("liquid")) {
    const Json& liquid = json.at("liquid");
    replay.liquid = {liquid.at("part").get<int>(),     liquid.at("radius").get<double>(),
                     liquid.at("depth").get<double>(), liquid.at("rim").get<double>(),
                     track_of(liquid, "waves", 2),     track_of(liquid, "spilled", 1)};
  }
  json.at("running").get_to(replay.running);
  json.at("primitives").get_to(replay.primitives);
  json.at("joins").get_to(replay.joins);
  replay.camera = {vector_of<3>(json.at("camera").at("from")),
                   vector_of<3>(json.at("camera").at("at"))};
  return replay;
}

void require_consistent(const Replay& replay) {
  const Eigen::Index N = replay.frames();
  const auto same = [&](const char* what, Eigen::Index rows) {
    if (rows != N)
      throw Error(std::string(what) + " of " + std::to_string(rows) + " frames, must be " +
                  std::to_string(N) + " like the poses");
  };
  if (N < 1 || !(replay.frame_rate > 0.0)) throw Error("no frames");
  same("tool", replay.tool.rows());
  same("running", static_cast<Eigen::Index>(replay.running.size()));
  if (replay.grains) same("grains", replay.grains->positions.rows());
  if (!replay.liquid) return;
  same("waves", replay.liquid->waves.rows());
  same("spilled", replay.liquid->spilled.rows());
  const auto part = static_cast<std::size_t>(replay.liquid->part);
  if (part >= replay.parts.size())
    throw Error("liquid in part " + std::to_string(part) + ", which is not there");
}

}  // namespace

Eigen::Isometry3d Replay::pose(Eigen::Index frame, std::size_t part) const {
  const Eigen::Matrix<float, 7, 1> row =
      poses.block<1, 7>(frame, 7 * static_cast<Eigen::Index>(part)).transpose();
  return pose_of(row);
}

void Replay::set_pose(Eigen::Index frame, std::size_t part, const Eigen::Isometry3d& X_world_part) {
  const Eigen::Quaternionf q(X_world_part.linear().cast<float>());
  poses.block<1, 7>(frame, 7 * static_cast<Eigen::Index>(part))
      << X_world_part.translation().cast<float>().transpose(),
      q.coeffs().transpose();
}

void Replay::write(const std::string& path) const {
  Json json{{"format", 1},
            {"scene", scene},
            {"method", method},
            {"frame_rate", frame_rate},
            {"time0", 0.0},
            {"parts", Json::array()},
            {"frames", text_of(poses)}};
  for (const Part& part : parts) json["parts"].push_back(to_json(part));
  if (grains)
    json["grains"] = {{"radius", grains->radius},
                      {"count", grains->positions.cols() / 3},
                      {"positions", text_of(grains->positions)}};
  if (liquid)
    json["liquid"] = {{"part", liquid->part},
                      {"radius", liquid->radius},
                      {"depth", liquid->depth},
                      {"rim", liquid->rim},
                      {"waves", text_of(liquid->waves)},
                      {"spilled", text_of(liquid->spilled)}};
  json["tool"] = text_of(tool);
  json["running"] = running;
  json["primitives"] = primitives;
  json["joins"] = joins;
  json["camera"] = {{"from", numbers(camera.from)}, {"at", numbers(camera.at)}};
  write_whole(path, json.dump() + "\n");
}

Replay Replay::read(const std::string& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path))
    throw Error(path,
                "cannot be read: " + std::string(file ? "is a folder" : std::strerror(errno)));
  try {
    Replay replay = replay_of(Json::parse(file), std::filesystem::path(path).parent_path());
    require_consistent(replay);
    return replay;
  } catch (const Json::exception& error) {
    throw Error(path, std::string("no replay: ") + error.what());
  } catch (const Error& error) {
    throw Error(path, error.what());
  }
}

}  // namespace seam
