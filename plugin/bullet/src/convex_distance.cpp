#include "convex_distance.hpp"

#include <numeric>

#include <Eigen/Geometry>

namespace seam {
namespace {

using Eigen::Vector3d;
using Points = std::array<Vector3d, 4>;
using Shares = std::array<double, 4>;

double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return a.dot(b.cross(c));
}

/// The shares, but for a factor, of the first `count` points in that point which is nearest to the origin on the line, or in
/// the plane, through them.
Shares shares_of(const Points& points, int count) {
  const auto& [a, b, c, d] = points;
  if (count == 1) return {1.0};
  if (count == 2) return {b.dot(b - a), a.dot(a - b)};
  if (count == 4) return {volume(b, c, d), -volume(a, c, d), volume(a, b, d), -volume(a, b, c)};
  const Vector3d normal = (b - a).cross(c - a);
  return {volume(normal, b, c), volume(normal, c, a), volume(normal, a, b)};
}

}  // namespace

Vector3d Simplex::nearest_with(const Vector3d& point) noexcept {
  const Points before = points_;
  const int subsets = 1 << std::min(size_, 3);  // four surround the origin, but for rounding
  points_[0] = point;
  size_ = 1;
  Vector3d nearest = point;
  for (int subset = 1; subset < subsets; ++subset) {
    Points points = {point};
    int count = 1;
    for (int i = 0; i < 3; ++i)
      if (subset >> i & 1)
        points[static_cast<std::size_t>(count++)] = before[static_cast<std::size_t>(i)];
    const Shares shares = shares_of(points, count);
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    Vector3d between = Vector3d::Zero();
    bool is_between = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const double share = shares[i] / sum;
      is_between = is_between && share >= 0.0;
      between += share * points[i];
    }
    if (!is_between || !(between.squaredNorm() < nearest.squaredNorm())) continue;
    nearest = between;
    points_ = points;
    size_ = count;
  }
  return nearest;
}

}  // namespace seam
