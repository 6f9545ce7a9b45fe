#include "scenes/grains.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "plugin/arm/src/bullet_types.hpp"
#include "plugin/bullet/src/shapes.hpp"
#include "scenes/solids.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr int sides = 16;

void require(double value, const char* what, const char* name) {
  if (!(std::isfinite(value) && value > 0.0))
    throw Error(what, std::string(name) + " " + std::to_string(value) + ", must be > 0");
}

Inertial hollow(const VesselSettings& vessel) {
  const double r2 = vessel.radius * vessel.radius;
  const double across = vessel.mass * (0.5 * r2 + vessel.height * vessel.height / 12.0);
  const Eigen::Vector3d moments(across, across, vessel.mass * r2);
  return {vessel.mass, {0.0, 0.0, 0.5 * vessel.height}, moments.asDiagonal()};
}

// Rings of a layer, from the middle outwards; neighbours do not touch.
std::vector<Eigen::Vector2d> layer(double room, double pitch) {
  std::vector<Eigen::Vector2d> places{Eigen::Vector2d::Zero()};
  for (double r = pitch; r <= room; r += pitch) {
    const int around = static_cast<int>(2.0 * M_PI * r / pitch);
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * M_PI * i / around;
      places.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  }
  return places;
}

std::unique_ptr<btRigidBody> body(double mass, btCollisionShape& shape,
                                  const Eigen::Isometry3d& X) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0.0) shape.calculateLocalInertia(static_cast<btScalar>(mass), inertia);
  btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass), nullptr, &shape,
                                                inertia);
  info.m_startWorldTransform = bullet_pose(X);
  return std::make_unique<btRigidBody>(info);
}

}  // namespace

std::vector<Geometry> walls(const VesselSettings& vessel) {
  require(vessel.radius, "vessel", "radius");
  require(vessel.height, "vessel", "height");
  require(vessel.wall, "vessel", "wall");
  require(vessel.mass, "vessel", "mass");
  const double outside = vessel.radius + vessel.wall;
  const double width = 2.0 * outside * std::tan(M_PI / sides);
  std::vector<Geometry> boxes;
  for (int i = 0; i < sides; ++i) {
    const Eigen::AngleAxisd turned(2.0 * M_PI * i / sides, Eigen::Vector3d::UnitZ());
    const Eigen::Translation3d out(vessel.radius + 0.5 * vessel.wall, 0.0, 0.5 * vessel.height);
    boxes.push_back(box(turned * out, {vessel.wall, width, vessel.height}));
  }
  const Eigen::Translation3d below(0.0, 0.0, -0.5 * vessel.wall);
  boxes.push_back(box(Eigen::Isometry3d(below), {2.0 * outside, 2.0 * outside, vessel.wall}));
  return boxes;
}

void add_vessel(RobotModel& robot, const std::string& link, const Eigen::Isometry3d& X_link_vessel,
                const VesselSettings& vessel) {
  const Frame frame = robot.frame(link);
  if (frame.body < 0) throw Error("vessel", "link \"" + link + "\" does not move");
  Body& body = robot.bodies[static_cast<std::size_t>(frame.body)];
  const Eigen::Isometry3d X_body_vessel = frame.X_body_frame * X_link_vessel;
  body.inertial = body.inertial + X_body_vessel * hollow(vessel);
  body.collisions.clear();
  for (Geometry wall : walls(vessel)) {
    wall.X_body_shape = X_body_vessel * wall.X_body_shape;
    wall.link = link;
    body.collisions.push_back(std::move(wall));
  }
}

struct StandingVessel::Parts {
  btMultiBodyDynamicsWorld& world;
  Eigen::Isometry3d X_vessel_world;
  VesselSettings settings;
  BodyShape shape;
  std::unique_ptr<btRigidBody> body;
};

StandingVessel::StandingVessel(btMultiBodyDynamicsWorld& world,
                               const Eigen::Isometry3d& X_world_vessel,
                               const VesselSettings& vessel)
    : parts_(new Parts{world, X_world_vessel.inverse(), vessel,
                       make_shape(walls(vessel), Eigen::Isometry3d::Identity(), 0.0), nullptr}) {
  parts_->body = body(0.0, *parts_->shape.compound, X_world_vessel);
  world.addRigidBody(parts_->body.get());
}

StandingVessel::~StandingVessel() {
  parts_->world.removeRigidBody(parts_->body.get());
}

bool StandingVessel::holds(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d inside = parts_->X_vessel_world * point;
  return inside.head<2>().norm() <= parts_->settings.radius + parts_->settings.wall &&
         inside.z() >= 0.0 && inside.z() <= parts_->settings.height;
}

struct Grains::Parts {
  btMultiBodyDynamicsWorld& world;
  btSphereShape shape;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
};

Grains::Grains(btMultiBodyDynamicsWorld& world, const Eigen::Isometry3d& X_world_vessel,
               const VesselSettings& vessel, const GrainSettings& settings, int seed) {
  require(settings.radius, "grains", "radius");
  require(settings.mass, "grains", "mass");
  parts_.reset(new Parts{world, btSphereShape(static_cast<btScalar>(settings.radius)), {}});
  const double pitch = 2.2 * settings.radius;
  const double shift = 0.05 * settings.radius;
  const auto places = layer(vessel.radius - settings.radius - shift, pitch);
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  const auto by_chance = [&] {
    return shift * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);
  };
  for (int i = 0; i < settings.count; ++i) {
    const auto per_layer = static_cast<int>(places.size());
    const double z = settings.radius + pitch * (i / per_layer);
    if (z + settings.radius > vessel.height)
      throw Error("grains", std::to_string(settings.count) + ", do not fit into the vessel");
    const Eigen::Vector2d& place = places[static_cast<std::size_t>(i % per_layer)];
    const Eigen::Vector3d at(place.x() + by_chance(), place.y() + by_chance(), z);
    auto grain = body(settings.mass, parts_->shape, X_world_vessel * Eigen::Translation3d(at));
    grain->setFriction(static_cast<btScalar>(settings.friction));
    grain->setRestitution(static_cast<btScalar>(settings.restitution));
    grain->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(grain.get());
    parts_->bodies.push_back(std::move(grain));
  }
}

Grains::~Grains() {
  for (const auto& grain : parts_->bodies) parts_->world.removeRigidBody(grain.get());
}

int Grains::count() const noexcept {
  return static_cast<int>(parts_->bodies.size());
}

Eigen::Vector3d Grains::position(int grain) const {
  const btVector3& at =
      parts_->bodies[static_cast<std::size_t>(grain)]->getWorldTransform().getOrigin();
  return {at.x(), at.y(), at.z()};
}

double Grains::share_in(const StandingVessel& vessel) const {
  int inside = 0;
  for (int i = 0; i < count(); ++i) inside += vessel.holds(position(i)) ? 1 : 0;
  return static_cast<double>(inside) / count();
}

}  // namespace seam
