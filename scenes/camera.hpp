#pragma once

#include <Eigen/Core>

namespace seam {

/// Where a picture is taken from; up is the world's z.
struct Camera {
  Eigen::Vector3d from{1.9, -1.9, 1.3};  // [m] in the world
  Eigen::Vector3d at{0.3, 0.0, 0.55};    // [m] what it looks at
};

}  // namespace seam
