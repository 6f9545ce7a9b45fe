#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <sstream>

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>
#include <gmock/gmock.h>

#include "scenes/world.hpp"
#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include "tests/temp_folder.hpp"
#include <seam/error.hpp>
#include <seam/mesh.hpp>
#include <seam/robot.hpp>

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Points = std::vector<Vector3d>;

const std::string pa10 = SEAM_ASSETS "/pa10/pa10.urdf";

/// A link that collides as a mesh.
seam::RobotModel of_one_mesh(const std::string& mesh, double scale) {
  seam::Geometry geometry;
  geometry.scale.setConstant(scale);
  geometry.type = seam::Geometry::Type::mesh;
  geometry.mesh = mesh;
  seam::RobotModel model;
  model.base.link = "base";
  model.base.collisions = {geometry};
  model.frames.push_back({"base"});
  return model;
}

Points points_of(const std::string& mesh) {
  Points points;
  for (const seam::Mesh& part : seam::load_mesh(mesh))
    for (const auto& point : part.positions.colwise()) points.push_back(point.cast<double>());
  return points;
}

/// The vertices of the hull that a mesh collides as.
Points hull_of(const std::string& mesh, double tolerance, double scale = 1.0) {
  seam::World world;
  seam::RobotSettings settings;
  settings.hull_tolerance = tolerance;
  seam::Robot robot(of_one_mesh(mesh, scale), *world, settings);
  const auto& compound = static_cast<const btCompoundShape&>(
      *robot.multibody().getBaseCollider()->getCollisionShape());
  const auto& hull = static_cast<const btConvexHullShape&>(*compound.getChildShape(0));
  Points points;
  for (int i = 0; i < hull.getNumPoints(); ++i) {
    const btVector3 point = hull.getScaledPoint(i);
    points.emplace_back(point.x(), point.y(), point.z());
  }
  return points;
}

double size_of(const Points& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box.diagonal().norm();
}

struct Triangle {
  Vector3d a, b, c;
  Vector3d outwards() const { return (b - a).cross(c - a).normalized(); }
};

double distance(const Vector3d& p, const Vector3d& from, const Vector3d& to) {
  const double share = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
  return (from + share * (to - from) - p).norm();
}

double distance(const Vector3d& p, const Triangle& t) {
  const Vector3d n = t.outwards();
  const bool is_above = n.cross(t.b - t.a).dot(p - t.a) >= 0.0 &&
                        n.cross(t.c - t.b).dot(p - t.b) >= 0.0 &&
                        n.cross(t.a - t.c).dot(p - t.c) >= 0.0;
  if (is_above) return std::abs(n.dot(p - t.a));
  return std::min({distance(p, t.a, t.b), distance(p, t.b, t.c), distance(p, t.c, t.a)});
}

/// All triangles of vertices that have no vertex outside them.
std::vector<Triangle> faces_of(const Points& hull) {
  constexpr double rounding = 1e-9;
  std::vector<Triangle> faces;
  const auto add_if_face = [&](const Triangle& t) {
    if ((t.b - t.a).cross(t.c - t.a).norm() < 1e-12) return;
    const Vector3d n = t.outwards();
    for (const Vector3d& p : hull)
      if (n.dot(p - t.a) > rounding) return;
    faces.push_back(t);
  };
  for (std::size_t i = 0; i < hull.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        add_if_face({hull[i], hull[j], hull[k]});
        add_if_face({hull[i], hull[k], hull[j]});
      }
  return faces;
}

double outside(const Vector3d& p, const std::vector<Triangle>& faces) {
  double nearest = std::numeric_limits<double>::infinity();
  bool is_outside = false;
  for (const Triangle& face : faces) {
    is_outside = is_outside || face.outwards().dot(p - face.a) > 0.0;
    nearest = std::min(nearest, distance(p, face));
  }
  return is_outside ? nearest : 0.0;
}

class HullTolerance : public testing::TestWithParam<const char*> {};

TEST_P(HullTolerance, IsHeldByEveryPointOfTheMesh) {
  const std::string mesh = std::string(SEAM_ASSETS "/pa10/meshes/") + GetParam();
  const Points points = points_of(mesh);
  const Points exact = hull_of(mesh, 0.0);
  for (const double tolerance : {5e-3, 2e-3}) {
    SCOPED_TRACE(tolerance);
    const Points hull = hull_of(mesh, tolerance);
    const std::vector<Triangle> faces = faces_of(hull);
    double most = 0.0;
    for (const Vector3d& point : points) most = std::max(most, outside(point, faces));
    EXPECT_LE(most, std::min(tolerance, 0.01 * size_of(points)) + 1e-6);
    EXPECT_LT(hull.size(), exact.size());
    for (const Vector3d& vertex : hull)
      EXPECT_NE(std::find_if(points.begin(), points.end(),
                             [&](const Vector3d& p) { return (p - vertex).norm() < 1e-9; }),
                points.end());
  }
}

INSTANTIATE_TEST_SUITE_P(OfThePa10, HullTolerance,
                         testing::Values("S1_steel.obj", "E2_sky_blue.obj", "hand_steel.obj"));

TEST(HullTolerance, DoesTheSameAtAnySize) {
  const std::string mesh = SEAM_ASSETS "/pa10/meshes/E2_sky_blue.obj";
  const std::size_t count = hull_of(mesh, 2e-3).size();
  for (const double scale : {1e-3, 1e-2, 1e2, 1e6})
    EXPECT_NEAR(hull_of(mesh, scale * 2e-3, scale).size(), count, 2) << scale;
}

TEST(HullTolerance, OfZeroKeepsTheExactHull) {
  const std::string mesh = SEAM_ASSETS "/pa10/meshes/E2_sky_blue.obj";
  const Points points = points_of(mesh);
  const Points hull = hull_of(mesh, 0.0);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d n = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const auto support = [&](const Points& of) {
      double most = -1e9;
      for (const Vector3d& point : of) most = std::max(most, n.dot(point));
      return most;
    };
    EXPECT_NEAR(support(hull), support(points), 2e-4 * size_of(points));  // Bullet's rounding
  }
}

TEST(HullTolerance, IsRefusedIfItIsNoLength) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double tolerance : {-1e-3, nan, std::numeric_limits<double>::infinity()}) {
    seam::World world;
    seam::RobotSettings settings;
    settings.hull_tolerance = tolerance;
    EXPECT_THAT(seam::test::refusal([&] { seam::Robot::load(pa10, *world, settings); }),
                testing::HasSubstr("m, must be finite and >= 0"));
    EXPECT_EQ(world->getNumCollisionObjects(), 0);
  }
}

/// A square of side 2 in the plane z = 0, of many triangles.
std::string flat_mesh(double scale) {
  constexpr int n = 20;
  std::ostringstream obj;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k)
      obj << "v " << scale * (2.0 * i / n - 1.0) << ' ' << scale * (2.0 * k / n - 1.0) << " 0\n";
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const int at = 1 + i * (n + 1) + k;
      obj << "f " << at << ' ' << at + n + 1 << ' ' << at + n + 2 << ' ' << at + 1 << '\n';
    }
  return obj.str();
}

TEST(Hull, OfAFlatMeshIsFlat) {
  const TempFolder folder;
  for (const double scale : {0.05, 1.0, 1e6}) {
    SCOPED_TRACE(scale);
    const std::string mesh = folder.write("flat.obj", flat_mesh(scale));
    const Points hull = hull_of(mesh, 2e-3);
    EXPECT_GE(hull.size(), 4U);
    EXPECT_LE(hull.size(), 12U);
    EXPECT_NEAR(size_of(hull), scale * std::sqrt(8.0), 1e-4 * scale);
  }
}

TEST(Hull, OfATriangleIsTheTriangle) {
  const TempFolder folder;
  const std::string mesh = folder.write(
      "t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 6 5 4\n");
  EXPECT_EQ(hull_of(mesh, 2e-3).size(), 3U);
}

TEST(Hull, OfAMeshFarBeyondReasonIsRefused) {
  const TempFolder folder;
  const std::string mesh = folder.write("far.obj", "v 0 0 0\nv 2e9 0 0\nv 0 2e9 0\nf 1 2 3\n");
  EXPECT_THAT(seam::test::refusal([&] { hull_of(mesh, 2e-3); }),
              testing::HasSubstr("coordinate 2e+09 m, must be at most 1e+09 in magnitude"));
}

const btMultiBodyLinkCollider* collider(const seam::Robot& robot, int link) {
  return link < 0 ? robot.multibody().getBaseCollider() : robot.multibody().getLinkCollider(link);
}

/// By another algorithm of Bullet's than its steps use, and seam; 0 if they meet.
double distance(const btCollisionObject& a, const btCollisionObject& b) {
  const auto& shape_a = static_cast<const btCompoundShape&>(*a.getCollisionShape());
  const auto& shape_b = static_cast<const btCompoundShape&>(*b.getCollisionShape());
  double least = 1e9;
  for (int i = 0; i < shape_a.getNumChildShapes(); ++i)
    for (int j = 0; j < shape_b.getNumChildShapes(); ++j) {
      const auto* part_a = static_cast<const btConvexShape*>(shape_a.getChildShape(i));
      const auto* part_b = static_cast<const btConvexShape*>(shape_b.getChildShape(j));
      const btTransform X_a = a.getWorldTransform() * shape_a.getChildTransform(i);
      const btTransform X_b = b.getWorldTransform() * shape_b.getChildTransform(j);
      btGjkEpaSolver2::sResults result{};
      const bool are_apart = btGjkEpaSolver2::Distance(part_a, X_a, part_b, X_b,
                                                       X_b.getOrigin() - X_a.getOrigin(), result);
      const double margins = part_a->getMargin() + part_b->getMargin();
      least = std::min(least, are_apart ? result.distance - margins : 0.0);
    }
  return least;
}

/// A random position within the limits (continuous joints: all around), often at one of them.
VectorXd position(const seam::RobotModel& model, std::mt19937& random) {
  VectorXd q(model.dof());
  for (int i = 0; i < model.dof(); ++i) {
    const seam::Joint& joint = model.joints[static_cast<std::size_t>(i)];
    const double lower = std::max(joint.lower, -M_PI), upper = std::min(joint.upper, M_PI);
    const double share = std::uniform_real_distribution<double>(-0.2, 1.2)(random);
    q(i) = lower + std::clamp(share, 0.0, 1.0) * (upper - lower);
  }
  return q;
}

/// The PA-10, each of its bodies as one mesh.
seam::RobotModel pa10_of_meshes() {
  seam::RobotModel model = seam::RobotModel::read(pa10);
  const auto first_mesh = [](seam::Body& body) {
    if (!body.visuals.empty()) body.collisions = {body.visuals.front()};
  };
  first_mesh(model.base);
  for (seam::Body& body : model.bodies) first_mesh(body);
  return model;
}

void expect_apart_where_left_out(const seam::RobotModel& model, int at_least) {
  const unsigned seed = 7;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  seam::World world;
  seam::Robot robot(model, *world);
  std::set<std::pair<int, int>> left_out;
  for (int sample = 0; sample < 500; ++sample) {
    const VectorXd q = position(model, random);
    robot.reset(q, VectorXd::Zero(robot.dof()));
    for (int b = 0; b < robot.dof(); ++b)
      for (int a = -1; a < b; ++a) {
        const bool are_neighbours = model.joints[static_cast<std::size_t>(b)].parent == a;
        const auto *one = collider(robot, a), *other = collider(robot, b);
        if (are_neighbours || !one || !other || one->checkCollideWith(other)) continue;
        left_out.insert({a, b});
        EXPECT_FALSE(other->checkCollideWith(one));
        ASSERT_GE(distance(*one, *other), 0.02 - 1e-6) << a << " " << b << ": " << q.transpose();
      }
  }
  EXPECT_GE(left_out.size(), static_cast<std::size_t>(at_least));
}

TEST(NeverMeeting, IsTrueOfWhatIsLeftOut) {
  expect_apart_where_left_out(seam::RobotModel::read(pa10), 3);
  expect_apart_where_left_out(pa10_of_meshes(), 3);
  for (const char* name : {"gripper_arm", "scara", "six_joint"})
    expect_apart_where_left_out(
        seam::RobotModel::read(SEAM_TEST_DATA "/robots/" + std::string(name) + ".urdf"), 0);
}

/// Three boards of 0.4 m that fold up like a rule. Folded by more than 90° twice, the first and the last meet.
std::string folding_rule() {
  const auto link = [](const std::string& name) {
    return "<link name=\"" + name +
           R"("><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)"
           R"(<collision><origin xyz="0.2 0 0"/><geometry><box size="0.3 0.05 0.05"/></geometry></collision></link>)";
  };
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<joint name=\"to_" + child + R"(" type="revolute"><parent link=")" + parent +
           R"("/><child link=")" + child +
           R"("/><origin xyz="0.4 0 0"/><axis xyz="0 0 1"/><limit lower="-0.6" upper="0.6" effort="1" velocity="1"/></joint>)";
  };
  return "<robot name=\"rule\">" + link("a") + link("b") + link("c") + joint("a", "b") +
         joint("b", "c") + "</robot>";
}

int contacts(btMultiBodyDynamicsWorld& world) {
  world.stepSimulation(btScalar(1e-6), 0);
  int contacts = 0;
  for (int i = 0; i < world.getDispatcher()->getNumManifolds(); ++i)
    contacts += world.getDispatcher()->getManifoldByIndexInternal(i)->getNumContacts();
  return contacts;
}

TEST(NeverMeeting, HoldsWithinTheLimitsOnlyAndLeavesNoContactBehind) {
  const TempFolder folder;
  seam::World world;
  world->setGravity(btVector3(0, 0, 0));
  auto robot = seam::Robot::load(folder.write("rule.urdf", folding_rule()), *world);
  const auto put = [&](double q) { robot.reset(VectorXd::Constant(2, q), VectorXd::Zero(2)); };
  const auto *first = collider(robot, -1), *last = collider(robot, 1);
  put(0.6);
  EXPECT_FALSE(first->checkCollideWith(last));
  put(2.5);  // nothing in Bullet holds it within its limits
  EXPECT_TRUE(first->checkCollideWith(last));
  EXPECT_GT(contacts(*world), 0);
  put(0.6);
  EXPECT_EQ(contacts(*world), 0);
  put(2.5);
  EXPECT_GT(contacts(*world), 0);
}

TEST(NeverMeeting, IsNotAskedOfOthers) {
  const TempFolder folder;
  seam::World world;
  const auto robot = seam::Robot::load(folder.write("rule.urdf", folding_rule()), *world);
  seam::RobotSettings beside;
  beside.X_world_base.translation().z() = 0.04;
  const auto other = seam::Robot::load(folder.path("rule.urdf"), *world, beside);
  EXPECT_FALSE(collider(robot, -1)->checkCollideWith(collider(robot, 1)));
  EXPECT_TRUE(collider(robot, -1)->checkCollideWith(collider(other, 1)));
  EXPECT_GT(contacts(*world), 0);
}

TEST(NeverMeeting, CostsNoAllocationInAStep) {
  seam::World world;
  seam::Robot robot(pa10_of_meshes(), *world);
  world->setGravity(
      btVector3(0, 0, 0));  // what comes near anew takes memory, as in Bullet everywhere
  VectorXd q(7);
  q << 0.1, 0.4, -0.1, 1.2, 0.2, 0.8, 0.0;
  robot.reset(q, VectorXd::Zero(7));
  EXPECT_FALSE(collider(robot, 2)->checkCollideWith(collider(robot, 4)));
  for (int i = 0; i < 100; ++i) world->stepSimulation(btScalar(1e-3), 0);
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) world->stepSimulation(btScalar(1e-3), 0);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
