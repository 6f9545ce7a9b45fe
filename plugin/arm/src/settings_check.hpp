#pragma once

#include <cmath>
#include <string>

#include <seam/error.hpp>
#include <seam/per_joint.hpp>

namespace seam {

/// @throws Error  not as many values as joints
inline void require_one_each(const std::string& what, const Eigen::VectorXd& values, int joints) {
  if (values.size() != joints)
    throw Error(what, std::to_string(values.size()) + " numbers, must be " +
                          std::to_string(joints) + ", one for each joint");
}

/// A setting for each of a robot's joints.
/// @throws Error  not as many as joints, or one that is not finite and ≥ 0
inline Eigen::VectorXd not_negative(const std::string& what, const PerJoint& setting, int joints) {
  Eigen::VectorXd each = setting.each(joints);
  require_one_each(what, each, joints);
  for (const double value : each)
    if (!(std::isfinite(value) && value >= 0.0))
      throw Error(what, std::to_string(value) + ", must be >= 0");
  return each;
}

}  // namespace seam
