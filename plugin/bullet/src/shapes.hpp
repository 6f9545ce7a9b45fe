#pragma once

#include <memory>
#include <vector>

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <seam/robot_model.hpp>

namespace seam {

/// The collision shapes of one body as one compound, with all that it is made of.
struct BodyShape {
  std::unique_ptr<btCompoundShape> compound;
  std::vector<std::unique_ptr<btConvexShape>> parts;

  const btTransform& pose(std::size_t i) const {
    return compound->getChildTransform(static_cast<int>(i));
  }
};

/// @param X_body_link     the frame that the compound will be placed by, in the body frame
/// @param hull_tolerance  [m] see RobotSettings
/// @throws Error          see Robot
BodyShape make_shape(const std::vector<Geometry>& geometries, const Eigen::Isometry3d& X_body_link,
                     double hull_tolerance);

}  // namespace seam
