#include "few_vertices.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include <Eigen/Geometry>

#include "convex_distance.hpp"

namespace seam {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

std::size_t furthest(const Points& points, const Vector3d& direction) {
  std::size_t found = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double how_far = direction.dot(points[i]);
    if (how_far > most) {
      most = how_far;
      found = i;
    }
  }
  return found;
}

void leave_out_copies(Points& points) {
  std::sort(points.begin(), points.end(), [](const Vector3d& a, const Vector3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

double size_of(const Points& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box.diagonal().norm();
}

/// Chooses points in many directions, then again and again the one that is furthest from the hull of those before.
class Choice {
 public:
  Choice(const Points& points, double tolerance)
      : points_(points),
        size_(size_of(points)),
        tolerance_(std::clamp(tolerance, 1e-5 * size_, 0.01 * size_)),
        is_chosen_(points.size(), false) {}

  const Points& make() {
    choose_in_many_directions();
    for (std::size_t i = 0; i < points_.size(); ++i) look_at(i);
    while (!outside_.empty()) {
      const Outside point = outside_.top();
      outside_.pop();
      if (point.of == chosen_.size()) choose_beyond(point);
      look_at(point.index);  // distances fall as the hull grows
    }
    return chosen_;
  }

 private:
  /// A point outside the hull of some that were chosen.
  struct Outside {
    double distance;
    Vector3d outwards;
    std::size_t index, of;
    bool operator<(const Outside& other) const { return distance < other.distance; }
  };

  void choose_in_many_directions() {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) choose(furthest(points_, Vector3d(x, y, z) + aside_));
  }

  void choose(std::size_t i) {
    if (is_chosen(i)) return;
    is_chosen_[i] = true;
    chosen_.push_back(points_[i]);
  }

  bool is_chosen(std::size_t i) const { return is_chosen_[i]; }

  void look_at(std::size_t i) {
    if (is_chosen(i)) return;
    const Vector3d& from = points_[i];
    const Distance distance = distance_from_origin(
        [&](const Vector3d& direction) -> Vector3d {
          return chosen_[furthest(chosen_, direction)] - from;
        },
        tolerance_);
    if (distance.at_most > tolerance_)
      outside_.push({distance.at_most, -distance.nearest / distance.at_most, i, chosen_.size()});
  }

  // Of points that are equally far outside (those of a flat face, say), one at a corner.
  void choose_beyond(const Outside& point) {
    const double slant = 0.1 * point.distance / size_;
    const std::size_t corner = furthest(points_, point.outwards + slant * aside_);
    choose(is_chosen(corner) ? point.index : corner);
  }

  const Vector3d aside_{0.12, 0.23, -0.17};  // along no edge, most likely
  const Points& points_;
  const double size_, tolerance_;  // [m]
  Points chosen_;
  std::vector<bool> is_chosen_;
  std::priority_queue<Outside> outside_;
};

}  // namespace

std::vector<Vector3d> few_vertices(std::vector<Vector3d> points, double tolerance) {
  leave_out_copies(points);
  return Choice(points, tolerance).make();
}

}  // namespace seam
