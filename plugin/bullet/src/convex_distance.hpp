#pragma once

#include <algorithm>

#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace seam {

/// What is known of the distance of a convex set from the origin [m]. Both bounds hold however early the search stops.
struct Distance {
  btScalar at_least = 0;
  btScalar at_most = SIMD_INFINITY;
  btVector3 nearest{0, 0, 0};  // the point of the set that at_most is the distance of
};

/// Looks for the point of a convex set that is nearest to the origin (Gilbert, Johnson and Keerthi), until at_most is `near`
/// or less, at_least is `far` or more, or the bounds are within 5 % of each other.
/// @param furthest  tells the set's point that is furthest in a direction, whose length does not matter
template <typename Furthest>
Distance distance_from_origin(const Furthest& furthest, btScalar near,
                              btScalar far = SIMD_INFINITY) {
  constexpr int most_rounds = 50;
  constexpr btScalar alike = btScalar(0.95);
  const btVector3 origin(0, 0, 0);
  btVoronoiSimplexSolver simplex;
  simplex.reset();
  Distance distance;
  btVector3 nearest = furthest(btVector3(1, 0, 0));
  simplex.addVertex(nearest, nearest, origin);
  for (int round = 0; round < most_rounds && nearest.length() < distance.at_most; ++round) {
    distance.nearest = nearest;
    distance.at_most = nearest.length();
    if (distance.at_most <= near) break;
    const btVector3 point = furthest(-nearest);
    distance.at_least = std::max(distance.at_least, nearest.dot(point) / distance.at_most);
    if (distance.at_least >= std::min(far, alike * distance.at_most)) break;
    if (simplex.inSimplex(point)) break;
    simplex.addVertex(point, point, origin);
    if (!simplex.closest(nearest)) break;
  }
  return distance;
}

}  // namespace seam
