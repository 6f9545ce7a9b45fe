#include "scenes/view/stage.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/view/shapes.hpp"
#include <seam/mesh.hpp>

namespace seam {

namespace {

constexpr double room = 0.25;            // [m] beside what moves
constexpr double mark_size = 2.5;        // of a join, in radii of the trail
constexpr double small_mark_size = 1.3;  // of a change on the way
const Eigen::Vector3f water(0.03F, 0.42F, 0.84F);
const Eigen::Vector3f overflow(0.93F, 0.16F, 0.10F);
const Eigen::Vector3f grain(0.78F, 0.16F, 0.20F);
const Eigen::Vector3f dark(0.13F, 0.14F, 0.16F);

Eigen::Matrix4f scaled(const Eigen::Vector3d& at, const Eigen::Vector3d& size) {
  Eigen::Affine3d X = Eigen::Translation3d(at) * Eigen::Scaling(size);
  return X.matrix().cast<float>();
}

// Greys without colour are metal.
Item::Finish finish_of(const Eigen::Vector3f& colour) {
  const bool grey = colour.maxCoeff() - colour.minCoeff() < 0.03F;
  return grey && colour.x() > 0.45F && colour.x() < 0.8F ? Item::Finish::metal
                                                         : Item::Finish::painted;
}

Item item_of(const Mesh& mesh, const Eigen::Isometry3d& X, const Eigen::Vector3d& scale,
             const Eigen::Vector3f& colour) {
  Item item;
  item.mesh = std::make_shared<GpuMesh>(mesh);
  item.X_world_mesh = (X * Eigen::Scaling(scale)).matrix().cast<float>();
  item.colour = colour;
  item.finish = finish_of(colour);
  return item;
}

std::vector<Mesh> meshes_of(const Geometry& shape) {
  switch (shape.type) {
    case Geometry::Type::box:
      return {box(shape.size)};
    case Geometry::Type::cylinder:
      return {cylinder(shape.size[0], shape.size[2])};
    case Geometry::Type::sphere:
      return {sphere(shape.size[0])};
    case Geometry::Type::mesh:
      return load_mesh(shape.mesh);
    case Geometry::Type::capsule:
      break;  // is only touched
  }
  return {};
}

}  // namespace

Stage::Stage(Replay replay)
    : replay_(std::move(replay)),
      ball_(std::make_shared<GpuMesh>(sphere(1.0))),
      disc_(std::make_shared<GpuMesh>(cylinder(1.0, 1.0))),
      drops_(drops(replay_)) {
  for (const Replay::Part& part : replay_.parts) add_part(part);
}

void Stage::add_part(const Replay::Part& part) {
  Shapes& shapes = parts_.emplace_back();
  for (const Geometry& shape : part.visuals)
    for (const Mesh& mesh : meshes_of(shape)) {
      const Eigen::Vector3f colour = shape.has_colour
                                         ? Eigen::Vector3f(shape.colour.head<3>().cast<float>())
                                         : Eigen::Vector3f(mesh.colour.head<3>());
      shapes.push_back(item_of(mesh, shape.X_body_shape, shape.scale, colour));
    }
  if (!part.vessel) return;
  shapes.push_back(item_of(vessel(*part.vessel), Eigen::Isometry3d::Identity(),
                           Eigen::Vector3d::Ones(), Eigen::Vector3f::Ones()));
  shapes.back().finish = Item::Finish::glass;
  shapes.back().shadow = false;
}

double Stage::duration() const {
  return static_cast<double>(replay_.frames() - 1) / replay_.frame_rate;
}

Eigen::AlignedBox3d Stage::around() const {
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < replay_.frames(); ++i) {
    for (std::size_t part = 0; part < replay_.parts.size(); ++part)
      box.extend(replay_.pose(i, part).translation());
    box.extend(replay_.tool.row(i).transpose().cast<double>());
  }
  const Eigen::Vector3d more = Eigen::Vector3d::Constant(room);
  return {box.min() - more, box.max() + more};
}

Eigen::Vector3f Stage::colour(int primitive) {
  const Eigen::Vector3f colours[] = {
      {0.00F, 0.45F, 0.70F}, {0.90F, 0.45F, 0.00F}, {0.00F, 0.62F, 0.45F}, {0.80F, 0.40F, 0.65F}};
  if (primitive < 0) return Eigen::Vector3f::Constant(0.6F);
  return colours[primitive % 4];
}

Stage::Moment Stage::moment(double time) const {
  const double at =
      std::clamp(time * replay_.frame_rate, 0.0, static_cast<double>(replay_.frames() - 1));
  const auto frame =
      std::min(static_cast<Eigen::Index>(at), std::max<Eigen::Index>(replay_.frames() - 2, 0));
  return {frame, at - static_cast<double>(frame)};
}

Eigen::VectorXd Stage::between(const Replay::Track& track, double time) const {
  const auto [frame, share] = moment(time);
  const Eigen::Index next = std::min(frame + 1, replay_.frames() - 1);
  return ((1.0 - share) * track.row(frame).cast<double>() + share * track.row(next).cast<double>())
      .transpose();
}

Eigen::Isometry3d Stage::pose(const Moment& moment, std::size_t part) const {
  const Eigen::Isometry3d a = replay_.pose(moment.frame, part);
  const Eigen::Isometry3d b = replay_.pose(std::min(moment.frame + 1, replay_.frames() - 1), part);
  const Eigen::Vector3d at = a.translation() + moment.share * (b.translation() - a.translation());
  return Eigen::Translation3d(at) *
         Eigen::Quaterniond(a.linear()).slerp(moment.share, Eigen::Quaterniond(b.linear()));
}

std::vector<Item> Stage::at(double time, double trail) const {
  std::vector<Item> items;
  const Moment now = moment(time);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const Eigen::Matrix4f X = pose(now, part).matrix().cast<float>();
    for (Item item : parts_[part]) {
      item.X_world_mesh = X * item.X_world_mesh;
      items.push_back(std::move(item));
    }
  }
  if (replay_.grains) {
    const Eigen::VectorXd positions = between(replay_.grains->positions, time);
    for (Eigen::Index i = 0; i < positions.size(); i += 3)
      items.push_back(
          {ball_,
           scaled(positions.segment<3>(i), Eigen::Vector3d::Constant(replay_.grains->radius)),
           grain});
  }
  if (replay_.liquid) add_liquid(time, items);
  add_drops(time, items);
  add_trail(time, trail, items);
  return items;
}

void Stage::add_liquid(double time, std::vector<Item>& items) const {
  const Replay::Liquid& settings = *replay_.liquid;
  const Eigen::Isometry3d X = pose(moment(time), static_cast<std::size_t>(settings.part));
  items.push_back(item_of(liquid(settings, between(settings.waves, time).head<2>()), X,
                          Eigen::Vector3d::Ones(), water));
  items.back().limit = static_cast<float>(settings.depth + settings.rim);
  items.back().above = overflow;
}

void Stage::add_drops(double time, std::vector<Item>& items) const {
  for (const Drop& drop : drops_) {
    if (time < drop.leaves) continue;
    const bool landed = time > drop.lands;
    const Eigen::Vector3d size =
        landed ? Eigen::Vector3d(3.65, 3.65, 0.1) : Eigen::Vector3d(1.0, 1.0, 1.0);
    Item item{landed ? disc_ : ball_, scaled(drop.position(time), drop.radius * size), overflow};
    items.push_back(std::move(item));
  }
}

// What has been passed shines and gets thicker from primitive to primitive, so that the last is seen where they meet; what
// is to come is pale and thin.
void Stage::add_trail(double time, double thickness, std::vector<Item>& items) const {
  const auto now = static_cast<Eigen::Index>(moment(time).frame);
  for (Eigen::Index begin = 0; begin + 1 < replay_.frames();) {
    const int primitive = replay_.running[static_cast<std::size_t>(begin)];
    Eigen::Index end = begin + 1;
    const bool passed = begin < now;
    while (end + 1 < replay_.frames() &&
           replay_.running[static_cast<std::size_t>(end)] == primitive && (end < now) == passed)
      ++end;
    std::vector<Eigen::Vector3f> path;
    for (Eigen::Index i = begin; i <= end; ++i) path.push_back(replay_.tool.row(i).transpose());
    Eigen::Vector3f hue = colour(primitive);
    if (!passed) hue = 0.25F * hue + Eigen::Vector3f::Constant(0.69F);
    const double radius = thickness * (passed ? 1.0 + 0.06 * primitive : 0.5);
    items.push_back(
        item_of(tube(path, radius), Eigen::Isometry3d::Identity(), Eigen::Vector3d::Ones(), hue));
    items.back().finish = Item::Finish::shining;
    items.back().shadow = false;
    begin = end;
  }
  for (const double join : replay_.joins) {
    if (join > time) continue;
    const Moment at_join = moment(join);
    const auto before = static_cast<std::size_t>(at_join.frame);
    const auto after = std::min(before + 1, replay_.running.size() - 1);
    const bool hands_over = replay_.running[before] != replay_.running[after];
    Item mark{
        ball_,
        scaled(between(replay_.tool, join),
               Eigen::Vector3d::Constant(thickness * (hands_over ? mark_size : small_mark_size))),
        dark};
    mark.finish = Item::Finish::shining;
    mark.shadow = false;
    items.push_back(std::move(mark));
  }
}

Eigen::Vector3d Stage::focus(double time) const {
  if (replay_.liquid) {
    const Replay::Liquid& in = *replay_.liquid;
    return pose(moment(time), static_cast<std::size_t>(in.part)) *
           Eigen::Vector3d(0.0, 0.0, 0.7 * (in.depth + in.rim));
  }
  if (replay_.grains) {
    const Eigen::VectorXd at = between(replay_.grains->positions, time);
    return Eigen::Map<const Eigen::Matrix3Xd>(at.data(), 3, at.size() / 3).rowwise().mean();
  }
  return between(replay_.tool, time);
}

double Stage::wave(double time) const {
  return replay_.liquid ? between(replay_.liquid->waves, time).norm() : 0.0;
}

double Stage::spilled(double time) const {
  return replay_.liquid ? between(replay_.liquid->spilled, time)(0) : 0.0;
}

}  // namespace seam
