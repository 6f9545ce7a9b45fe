#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Core>

namespace seam {

/// What is known of the distance of a convex set from the origin [m]. Both bounds hold however early the search stops.
struct Distance {
  double at_least = 0.0;
  double at_most = std::numeric_limits<double>::infinity();
  Eigen::Vector3d nearest =
      Eigen::Vector3d::Zero();  // the point of the set that at_most is the distance of
};

/// Up to four points of a convex set.
class Simplex {
 public:
  /// Adds a point, and keeps those that it needs to come nearest to the origin together with them.
  /// @return the point between them (a sum of shares ≥ 0 of them) that is nearest
  Eigen::Vector3d nearest_with(const Eigen::Vector3d& point) noexcept;

 private:
  std::array<Eigen::Vector3d, 4> points_;
  int size_ = 0;
};

/// Looks for the point of a convex set that is nearest to the origin (Gilbert, Johnson and Keerthi), until at_most is `near`
/// or less, at_least is `far` or more, or the bounds are within 5 % of each other. In double in either precision of Bullet, whose
/// own takes points 1 cm apart for one in float.
/// @param furthest  tells the set's point that is furthest in a direction, whose length does not matter
template <typename Furthest>
Distance distance_from_origin(const Furthest& furthest, double near,
                              double far = std::numeric_limits<double>::infinity()) {
  constexpr int most_rounds = 50;
  constexpr double alike = 0.95;
  Simplex simplex;
  Distance distance;
  Eigen::Vector3d nearest = simplex.nearest_with(furthest(Eigen::Vector3d::UnitX()));
  for (int round = 0; round < most_rounds && nearest.norm() < distance.at_most; ++round) {
    distance.nearest = nearest;
    distance.at_most = nearest.norm();
    if (distance.at_most <= near) break;
    const Eigen::Vector3d point = furthest(-nearest);
    distance.at_least = std::max(distance.at_least, nearest.dot(point) / distance.at_most);
    if (distance.at_least >= std::min(far, alike * distance.at_most)) break;
    nearest = simplex.nearest_with(point);
  }
  return distance;
}

}  // namespace seam
