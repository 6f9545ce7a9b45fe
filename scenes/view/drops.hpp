#pragma once

#include <vector>

#include "scenes/replay.hpp"

namespace seam {

/// A drop that falls freely from the rim and stays where it lands.
struct Drop {
  double leaves = 0.0, lands = 0.0;  // [s]
  Eigen::Vector3d from, velocity;    // [m], [m/s]
  double radius = 0.0;               // [m]

  Eigen::Vector3d position(double time) const;
};

/// What spills, drawn as drops: they leave where the wave is above the rim, together hold what has risen above it, and land on
/// a table or the floor. The model knows no drops (see liquid.hpp): they are an illustration of its figures.
std::vector<Drop> drops(const Replay& replay);

}  // namespace seam
