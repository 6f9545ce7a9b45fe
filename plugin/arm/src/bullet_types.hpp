#pragma once

#include <Eigen/Geometry>
#include <LinearMath/btTransform.h>

namespace seam {

inline btVector3 bullet_vector(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

inline btMatrix3x3 bullet_matrix(const Eigen::Matrix3d& m) {
  btMatrix3x3 result;
  for (int row = 0; row < 3; ++row) result[row] = bullet_vector(m.row(row));
  return result;
}

inline btQuaternion bullet_rotation(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(R).normalized();
  return {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
          static_cast<btScalar>(q.w())};
}

inline btTransform bullet_pose(const Eigen::Isometry3d& X) {
  return btTransform(bullet_rotation(X.linear()), bullet_vector(X.translation()));
}

inline Eigen::Vector3d eigen_vector(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

inline Eigen::Matrix3d eigen_rotation(const btQuaternion& q) {
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
}

}  // namespace seam
