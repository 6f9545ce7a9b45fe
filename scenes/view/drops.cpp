#include "scenes/view/drops.hpp"

#include <algorithm>
#include <cmath>

namespace seam {

namespace {

constexpr double g = 9.81;  // [m/s²]
constexpr int drops_per_frame = 3;
constexpr double spread = 0.5;           // [rad] to either side of the wave
constexpr double speed_outwards = 0.12;  // [m/s]

// Height of what lies below a point.
double ground(const Replay& replay, const Eigen::Vector3d& point) {
  for (const Replay::Part& part : replay.parts) {
    if (part.name != "table") continue;
    const Geometry& box = part.visuals.front();
    const Eigen::Vector3d in_box = box.X_body_shape.inverse() * point;
    if ((in_box.head<2>().cwiseAbs() - 0.5 * box.size.head<2>()).maxCoeff() < 0.0)
      return box.X_body_shape.translation().z() + 0.5 * box.size.z();
  }
  return 0.0;
}

double fall_time(double height, double upwards) {
  return (upwards + std::sqrt(upwards * upwards + 2.0 * g * std::max(height, 0.0))) / g;
}

Drop drop_at(const Replay& replay, Eigen::Index frame, double aside, double radius) {
  const Replay::Liquid& liquid = *replay.liquid;
  const auto part = static_cast<std::size_t>(liquid.part);
  const Eigen::Isometry3d X = replay.pose(frame, part);
  const Eigen::Isometry3d before = replay.pose(std::max<Eigen::Index>(frame - 1, 0), part);
  const double angle = std::atan2(liquid.waves(frame, 1), liquid.waves(frame, 0)) + aside;
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
  const double wall = replay.parts[part].vessel ? replay.parts[part].vessel->wall : 0.0;
  Drop drop;
  drop.radius = radius;
  drop.leaves = static_cast<double>(frame) / replay.frame_rate;
  drop.from = X * ((liquid.radius + wall + radius) * out +
                   Eigen::Vector3d(0.0, 0.0, liquid.depth + liquid.rim));
  drop.velocity = replay.frame_rate * (X.translation() - before.translation()) +
                  speed_outwards * (X.linear() * out);
  const double height = drop.from.z() - ground(replay, drop.from) - 0.2 * radius;
  drop.lands = drop.leaves + fall_time(height, drop.velocity.z());
  return drop;
}

}  // namespace

Eigen::Vector3d Drop::position(double time) const {
  const double t = std::clamp(time, leaves, lands) - leaves;
  return from + t * velocity - Eigen::Vector3d(0.0, 0.0, 0.5 * g * t * t);
}

std::vector<Drop> drops(const Replay& replay) {
  std::vector<Drop> all;
  if (!replay.liquid) return all;
  const Replay::Liquid& liquid = *replay.liquid;
  std::vector<Eigen::Index> frames;
  for (Eigen::Index i = 0; i < replay.frames(); ++i)
    if (liquid.waves.row(i).norm() > liquid.rim) frames.push_back(i);
  if (frames.empty()) return all;
  const double volume =
      liquid.spilled(replay.frames() - 1, 0) * M_PI * liquid.radius * liquid.radius * liquid.depth;
  const double each = volume / static_cast<double>(drops_per_frame * frames.size());
  const double radius = std::cbrt(0.75 * each / M_PI);
  for (const Eigen::Index frame : frames)
    for (int k = 0; k < drops_per_frame; ++k) {
      // Evenly, but in another order in every frame.
      const double share =
          std::fmod(0.618034 * (drops_per_frame * static_cast<double>(frame) + k), 1.0);
      all.push_back(drop_at(replay, frame, spread * (2.0 * share - 1.0), radius));
    }
  return all;
}

}  // namespace seam
