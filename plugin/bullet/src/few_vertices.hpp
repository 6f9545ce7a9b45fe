#pragma once

#include <vector>

#include <Eigen/Core>

namespace seam {

/// As few of the points (at least one) as make a convex hull that no other point is further away from than the tolerance, or
/// than a hundredth of their size (the diagonal of their box) if that is less. Points may lie in a plane, on a line, or be
/// one and the same.
/// @param points     finite, at least one
/// @param tolerance  [m] counts as 1e-5 of the size if it is less, which rounding could not tell from 0
std::vector<Eigen::Vector3d> few_vertices(std::vector<Eigen::Vector3d> points, double tolerance);

}  // namespace seam
