#include "scenes/film.hpp"

#include <cmath>

namespace seam {

namespace {

constexpr double same_tick = 1e-6;  // of a tick

void appear(const RobotModel& robot, std::vector<Replay::Part>& parts) {
  parts.push_back({robot.base.link, robot.base.visuals, {}});
  for (const Body& body : robot.bodies) parts.push_back({body.link, body.visuals, {}});
}

// All that moves fits into the picture, seen from the right, in front and above.
Camera camera_around(const Replay& replay) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < replay.frames(); ++i) {
    for (std::size_t part = 0; part < replay.parts.size(); ++part)
      box.extend(replay.pose(i, part).translation());
    box.extend(replay.tool.row(i).transpose().cast<double>());
  }
  const Eigen::Vector3d direction(0.75, -0.8, 0.35);
  return {box.center() + 1.8 * box.diagonal().norm() * direction, box.center()};
}

}  // namespace

Film::Film(const Scene& scene, Join method, const Robot& robot,
           const std::vector<std::unique_ptr<Object>>& objects, double dt, int ticks,
           Replay& replay)
    : scene_(scene),
      robot_(robot),
      objects_(objects),
      replay_(replay),
      tool_(scene.tool_frame()),
      dt_(dt) {
  replay.scene = scene.name;
  replay.method = to_string(method);
  replay.primitives = scene.primitive_names;
  appear(scene.robot, replay.parts);
  for (std::size_t i = 0; i < replay.parts.size(); ++i)
    bodies_.push_back({"", static_cast<int>(i) - 1, Eigen::Isometry3d::Identity()});
  if (scene.table) replay.parts.push_back({"table", {*scene.table}, {}});
  for (const auto& object : objects) object->appear(replay);

  const auto frames =
      static_cast<Eigen::Index>((ticks - 1) * dt * replay.frame_rate + same_tick) + 1;
  const auto room = [&](Replay::Track& track, Eigen::Index columns) {
    track.setZero(frames, columns);
  };
  room(replay.poses, 7 * static_cast<Eigen::Index>(replay.parts.size()));
  room(replay.tool, 3);
  if (replay.grains) room(replay.grains->positions, replay.grains->positions.cols());
  if (replay.liquid) room(replay.liquid->waves, 2);
  if (replay.liquid) room(replay.liquid->spilled, 1);
  for (Eigen::Index i = 0; scene.table && i < frames; ++i)
    replay.set_pose(i, bodies_.size(), Eigen::Isometry3d::Identity());
}

int Film::tick_of(Eigen::Index frame) const {
  return static_cast<int>(static_cast<double>(frame) / (replay_.frame_rate * dt_) + same_tick);
}

void Film::pre_tick(int tick) {
  while (next_ < replay_.frames() && tick_of(next_) <= tick) take();
}

void Film::take() {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    replay_.set_pose(next_, i, robot_.X_world_frame(bodies_[i]));
  replay_.tool.row(next_) = robot_.X_world_frame(tool_).translation().cast<float>();
  for (const auto& object : objects_) object->film(next_, replay_);
  ++next_;
}

void Film::finish(const Recording& recording) {
  for (Eigen::Index i = 0; i < replay_.frames(); ++i)
    replay_.running.push_back(recording.running(tick_of(i)));
  for (const RecordedJoin& join : recording.joins) replay_.joins.push_back(join.time);
  replay_.camera = scene_.camera ? *scene_.camera : camera_around(replay_);
}

}  // namespace seam
