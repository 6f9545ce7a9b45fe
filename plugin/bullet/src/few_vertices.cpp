#include "few_vertices.hpp"

#include <algorithm>
#include <queue>
#include <tuple>
#include <vector>

#include "convex_distance.hpp"

namespace seam {
namespace {

using Points = btAlignedObjectArray<btVector3>;

int furthest(const Points& points, const btVector3& direction) {
  btScalar how_far = 0;
  return static_cast<int>(direction.maxDot(&points[0], points.size(), how_far));
}

void leave_out_copies(Points& points) {
  const auto coordinates = [](const btVector3& p) { return std::make_tuple(p.x(), p.y(), p.z()); };
  btVector3* const begin = &points[0];
  btVector3* const end = begin + points.size();
  std::sort(begin, end, [&](const btVector3& a, const btVector3& b) {
    return coordinates(a) < coordinates(b);
  });
  points.resize(static_cast<int>(std::unique(begin, end) - begin));
}

btScalar size_of(const Points& points) {
  btVector3 low = points[0], high = points[0];
  for (int i = 0; i < points.size(); ++i) {
    low.setMin(points[i]);
    high.setMax(points[i]);
  }
  return (high - low).length();
}

/// Chooses points in many directions, then again and again the one that is furthest from the hull of those before.
class Choice {
 public:
  Choice(const Points& points, double tolerance)
      : points_(points),
        size_(size_of(points)),
        tolerance_(std::clamp(btScalar(tolerance), btScalar(1e-5) * size_, btScalar(0.01) * size_)),
        is_chosen_(static_cast<std::size_t>(points.size()), false) {}

  const Points& make() {
    choose_in_many_directions();
    for (int i = 0; i < points_.size(); ++i) look_at(i);
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
    btScalar distance;
    btVector3 outwards;
    int index, of;
    bool operator<(const Outside& other) const { return distance < other.distance; }
  };

  void choose_in_many_directions() {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          choose(furthest(points_, btVector3(btScalar(x), btScalar(y), btScalar(z)) + aside_));
  }

  void choose(int i) {
    if (is_chosen(i)) return;
    is_chosen_[static_cast<std::size_t>(i)] = true;
    chosen_.push_back(points_[i]);
  }

  bool is_chosen(int i) const { return is_chosen_[static_cast<std::size_t>(i)]; }

  void look_at(int i) {
    if (is_chosen(i)) return;
    const btVector3& from = points_[i];
    const Distance distance = distance_from_origin(
        [&](const btVector3& direction) { return chosen_[furthest(chosen_, direction)] - from; },
        tolerance_);
    if (distance.at_most > tolerance_)
      outside_.push({distance.at_most, -distance.nearest / distance.at_most, i, chosen_.size()});
  }

  // Of points that are equally far outside (those of a flat face, say), one at a corner.
  void choose_beyond(const Outside& point) {
    const btScalar slant = btScalar(0.1) * point.distance / size_;
    const int corner = furthest(points_, point.outwards + slant * aside_);
    choose(is_chosen(corner) ? point.index : corner);
  }

  const btVector3 aside_{btScalar(0.12), btScalar(0.23),
                         btScalar(-0.17)};  // along no edge, most likely
  const Points& points_;
  const btScalar size_, tolerance_;  // [m]
  Points chosen_;
  std::vector<bool> is_chosen_;
  std::priority_queue<Outside> outside_;
};

}  // namespace

btAlignedObjectArray<btVector3> few_vertices(btAlignedObjectArray<btVector3> points,
                                             double tolerance) {
  leave_out_copies(points);
  return Choice(points, tolerance).make();
}

}  // namespace seam
