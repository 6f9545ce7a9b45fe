#include "scenes/obstacles.hpp"

#include <algorithm>
#include <limits>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "plugin/arm/src/bullet_types.hpp"
#include "plugin/bullet/src/shapes.hpp"
#include "plugin/files/src/yaml_reader.hpp"
#include "scenes/object.hpp"
#include "scenes/solids.hpp"
#include <seam/quintic.hpp>

namespace seam {

namespace {

constexpr std::size_t most_obstacles = 100;
constexpr double farthest = 10.0;  // [m] at which a distance is still measured
constexpr double nearest = 1e-3;   // [m] within which it always is

Geometry read_box(const YamlEntry& entry) {
  entry.only({"at", "size"});
  const YamlEntry size = entry.at("size");
  const Eigen::Vector3d edges = size.numbers(3, "edge");
  if (!(edges.minCoeff() > 0.0)) size.fail("must be > 0");
  return box(Eigen::Isometry3d::Identity(), edges);
}

Geometry read_ball(const YamlEntry& entry) {
  entry.only({"at", "radius"});
  return sphere(entry.at("radius").positive());
}

SolidObstacle read_obstacle(const YamlEntry& entry) {
  entry.only({"box", "ball", "moves"});
  const auto as_box = entry.find("box");
  const auto as_ball = entry.find("ball");
  if (as_box.has_value() == as_ball.has_value()) entry.fail("must have one of box, ball");
  SolidObstacle obstacle;
  obstacle.shape = coloured(as_box ? read_box(*as_box) : read_ball(*as_ball), 0.72, 0.24, 0.18);
  obstacle.at = (as_box ? *as_box : *as_ball).at("at").numbers(3, "direction");
  if (const auto moves = entry.find("moves")) {
    moves->only({"to", "from", "over"});
    obstacle.way = moves->at("to").numbers(3, "direction") - obstacle.at;
    obstacle.leaves = moves->at("from").not_negative();
    obstacle.over = moves->at("over").positive();
  }
  return obstacle;
}

struct LeastDistance final : btCollisionWorld::ContactResultCallback {
  explicit LeastDistance(double within) : least(within) {
    m_closestDistanceThreshold = static_cast<btScalar>(within);
  }
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    least = std::min(least, static_cast<double>(point.getDistance()));
    return 0;
  }
  double least;
};

// One of them in Bullet's world.
class Body {
 public:
  Body(const SolidObstacle& obstacle, btMultiBodyDynamicsWorld& world)
      : obstacle_(obstacle),
        world_(world),
        shape_(make_shape({obstacle.shape}, Eigen::Isometry3d::Identity(), 0.0)) {
    object_.setCollisionShape(shape_.parts.front().get());
    object_.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT |
                              btCollisionObject::CF_NO_CONTACT_RESPONSE);
    move(0.0);
    world.addCollisionObject(&object_, btBroadphaseProxy::KinematicFilter, 0);
  }
  ~Body() { world_.removeCollisionObject(&object_); }
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  void move(double time) {
    object_.setWorldTransform(
        btTransform(btQuaternion::getIdentity(), bullet_vector(obstacle_.position(time))));
  }
  Eigen::Isometry3d X_world_body() const {
    return Eigen::Isometry3d(
        Eigen::Translation3d(eigen_vector(object_.getWorldTransform().getOrigin())));
  }
  // At most `within`, which is what it is then said to be.
  double distance(btCollisionObject& other, double within) {
    LeastDistance distance(within);
    world_.contactPairTest(&object_, &other, distance);
    return distance.least;
  }

 private:
  const SolidObstacle& obstacle_;
  btMultiBodyDynamicsWorld& world_;
  BodyShape shape_;
  btCollisionObject object_;
};

class Obstacles final : public Object {
 public:
  Obstacles(const Scene& scene, Robot& robot) : obstacles_(scene.obstacles) {
    for (const SolidObstacle& obstacle : obstacles_)
      bodies_.push_back(std::make_unique<Body>(obstacle, robot.world()));
    for (int link = -1; link < robot.dof(); ++link)
      if (auto* const collider = link < 0 ? robot.multibody().getBaseCollider()
                                          : robot.multibody().getLinkCollider(link))
        links_.push_back(collider);
  }

  void pre_tick(Eigen::Index, double time) override {
    double now = std::max(least_, nearest);
    for (const auto& body : bodies_) {
      body->move(time);
      for (btCollisionObject* const link : links_) {
        const double within = std::max(now, nearest);
        now = std::min(now, body->distance(*link, within));
      }
    }
    least_ = std::min(least_, now);
    touched_ += now <= 0.0 ? 1 : 0;
    ++ticks_;
  }
  void appear(Replay& replay) override {
    part_ = replay.parts.size();
    for (const SolidObstacle& obstacle : obstacles_)
      replay.parts.push_back({"obstacle", {obstacle.shape}, {}});
  }
  void film(Eigen::Index frame, Replay& replay) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      replay.set_pose(frame, part_ + i, bodies_[i]->X_world_body());
  }
  void finish(Recording& recording) const override {
    recording.outcomes.push_back(
        {"touched_share", static_cast<double>(touched_) / std::max(ticks_, 1)});
    recording.outcomes.push_back({"obstacle_distance_m", least_, true});
  }

 private:
  const std::vector<SolidObstacle>& obstacles_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<btCollisionObject*> links_;
  double least_ = farthest;  // [m] so far
  int touched_ = 0;          // ticks
  int ticks_ = 0;
  std::size_t part_ = 0;
};

}  // namespace

Eigen::Vector3d SolidObstacle::position(double time) const {
  if (over == 0.0) return at;
  const double share = std::clamp((time - leaves) / over, 0.0, 1.0);
  return at + (1.0 - fade(share)) * way;
}

std::vector<SolidObstacle> read_obstacles(const YamlEntry& entry) {
  std::vector<SolidObstacle> obstacles;
  for (const YamlEntry& item : entry.items()) {
    if (obstacles.size() == most_obstacles) entry.fail("more than 100 obstacles");
    obstacles.push_back(read_obstacle(item));
  }
  return obstacles;
}

std::unique_ptr<Object> make_obstacles(const Scene& scene, Robot& robot) {
  return std::make_unique<Obstacles>(scene, robot);
}

}  // namespace seam
