#include "shapes.hpp"

#include <algorithm>

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "bullet_types.hpp"
#include "few_vertices.hpp"
#include "text.hpp"
#include <seam/error.hpp>
#include <seam/mesh.hpp>

namespace seam {
namespace {

constexpr double margin = 1e-3;   // [m] Bullet's 40 mm would round off edges and blow up hulls
constexpr double farthest = 1e9;  // [m] as in a URDF

std::vector<Eigen::Vector3d> points_of(const Geometry& geometry) {
  std::vector<Eigen::Vector3d> points;
  for (const Mesh& mesh : load_mesh(geometry.mesh)) {
    for (const auto& position : mesh.positions.colwise()) {
      points.emplace_back(position.cast<double>().cwiseProduct(geometry.scale));
      const double most = points.back().cwiseAbs().maxCoeff();
      if (!(most <= farthest))
        throw Error(geometry.mesh,
                    text("coordinate ", most, " m, must be at most ", farthest, " in magnitude"));
    }
  }
  return points;
}

std::unique_ptr<btConvexShape> make_hull(const Geometry& geometry, double tolerance) {
  const bool is_exact = tolerance == 0.0;
  auto points = points_of(geometry);
  if (!is_exact) points = few_vertices(std::move(points), tolerance);
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Eigen::Vector3d& point : points) hull->addPoint(bullet_vector(point), false);
  if (is_exact) hull->optimizeConvexHull();
  hull->setMargin(btScalar(margin));
  hull->recalcLocalAabb();  // which keeps the margin that it is made with
  return hull;
}

std::unique_ptr<btConvexShape> make_part(const Geometry& geometry, double hull_tolerance) {
  const btVector3 size = bullet_vector(geometry.size);
  switch (geometry.type) {
    case Geometry::Type::box:
      return std::make_unique<btBoxShape>(size / 2);
    case Geometry::Type::cylinder:
      return std::make_unique<btCylinderShapeZ>(btVector3(size.x(), size.x(), size.z() / 2));
    case Geometry::Type::capsule:
      return std::make_unique<btCapsuleShapeZ>(btScalar(size.x()), btScalar(size.z()));
    case Geometry::Type::sphere:
      return std::make_unique<btSphereShape>(size.x());
    default:
      return make_hull(geometry, hull_tolerance);
  }
}

}  // namespace

BodyShape make_shape(const std::vector<Geometry>& geometries, const Eigen::Isometry3d& X_body_link,
                     double hull_tolerance) {
  BodyShape shape;
  shape.compound = std::make_unique<btCompoundShape>(true, static_cast<int>(geometries.size()));
  for (const Geometry& geometry : geometries) {
    shape.parts.push_back(make_part(geometry, hull_tolerance));
    btConvexShape& part = *shape.parts.back();
    const bool is_round =
        geometry.type == Geometry::Type::sphere || geometry.type == Geometry::Type::capsule;
    if (!is_round)  // their margin is their radius
      part.setMargin(std::min(part.getMargin(), btScalar(margin)));
    shape.compound->addChildShape(bullet_pose(X_body_link.inverse() * geometry.X_body_shape),
                                  &part);
  }
  return shape;
}

}  // namespace seam
