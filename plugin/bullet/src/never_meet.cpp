#include "never_meet.hpp"

#include <cmath>
#include <queue>

#include "bullet_types.hpp"
#include "convex_distance.hpp"

namespace seam {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Line = Eigen::ParametrizedLine<double, 3>;

constexpr double apart = 0.02;          // [m]
constexpr double beyond_limits = 0.01;  // [rad or m]
constexpr int most_distances = 3000;    // of parts

const Joint& joint_of(const RobotModel& model, int link) {
  return model.joints[static_cast<std::size_t>(link)];
}

bool is_within_limits(const Joint& joint, double q) {
  return q >= joint.lower - beyond_limits && q <= joint.upper + beyond_limits;
}

double between_spheres(const btConvexShape& a, const btConvexShape& b, const btTransform& X_a_b) {
  btVector3 centre_a, centre_b;
  btScalar radius_a, radius_b;
  a.getBoundingSphere(centre_a, radius_a);
  b.getBoundingSphere(centre_b, radius_b);
  return (X_a_b * centre_b - centre_a).length() - radius_a - radius_b;
}

Distance distance(const btConvexShape& a, const btConvexShape& b, const btTransform& X_a_b,
                  double far) {
  const auto furthest = [&](const Vector3d& to) {
    const btVector3 direction = bullet_vector(to);
    return eigen_vector(X_a_b * b.localGetSupportingVertex(direction * X_a_b.getBasis()) -
                        a.localGetSupportingVertex(-direction));
  };
  return distance_from_origin(furthest, apart, far);
}

/// The smaller bounds of all pairs of parts, or that they are `far` apart or more.
/// @param count  is raised by the number of distances of parts that were needed
Distance distance(const BodyShape& a, const BodyShape& b, const btTransform& X_a_b, double far,
                  int& count) {
  Distance least;
  least.at_least = far;
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    const btTransform X_part_b = a.pose(i).inverse() * X_a_b;
    for (std::size_t j = 0; j < b.parts.size(); ++j) {
      const btTransform X = X_part_b * b.pose(j);
      if (between_spheres(*a.parts[i], *b.parts[j], X) >= least.at_least) continue;
      ++count;
      const Distance of_parts = distance(*a.parts[i], *b.parts[j], X, least.at_least);
      least.at_least = std::min(least.at_least, of_parts.at_least);
      least.at_most = std::min(least.at_most, of_parts.at_most);
    }
  }
  return least;
}

/// No point of the body is further [m] from the line, which is given in the body's frame.
double most_from(const Line& line, const CollidingBody& body) {
  double most = 0.0;
  for (std::size_t i = 0; i < body.shape->parts.size(); ++i) {
    btVector3 corner[2];
    body.shape->parts[i]->getAabb(body.shape->pose(i), corner[0], corner[1]);
    for (int k = 0; k < 8; ++k) {
      const Vector3d at(corner[k & 1].x(), corner[k >> 1 & 1].y(), corner[k >> 2].z());
      most = std::max(most, line.distance(body.X_body_link * at));
    }
  }
  return most;
}

/// A box of positions of both joints.
struct Cell {
  Vector2d centre, half;  // [rad or m]
  double at_least;        // [m] that the bodies are apart anywhere in it
  bool operator<(const Cell& other) const { return at_least > other.at_least; }  // nearest first
};

class Proof {
 public:
  Proof(const RobotModel& model, const CollidingBody& a, const CollidingBody& b,
        const TwoJoints& joints)
      : a_(a),
        b_(b),
        first_(joint_of(model, joints.first)),
        second_(joint_of(model, joints.second)),
        first_moves_a_(joints.first == a.link),
        reach_(reach(first_, a, first_moves_a_), reach(second_, b, true)) {}

  bool succeeds() {
    Cell all = {{middle(first_), middle(second_)}, {half_range(first_), half_range(second_)}, 0.0};
    if (!all.half.allFinite() || !add(all)) return false;
    while (!cells_.empty() && distances_ < most_distances) {
      Cell cell = cells_.top();
      cells_.pop();
      const int wide = reach_(0) * cell.half(0) > reach_(1) * cell.half(1) ? 0 : 1;
      cell.half(wide) *= 0.5;
      for (const double side : {-1.0, 1.0}) {
        Cell part = cell;
        part.centre(wide) += side * cell.half(wide);
        if (!add(part)) return false;
      }
    }
    return cells_.empty();
  }

 private:
  static bool turns_around(const Joint& joint) {
    return joint.type != Joint::Type::prismatic &&
           !(joint.upper - joint.lower + 2.0 * beyond_limits < 2.0 * M_PI);
  }
  static double middle(const Joint& joint) {
    return turns_around(joint) ? 0.0 : 0.5 * (joint.lower + joint.upper);
  }
  static double half_range(const Joint& joint) {
    return turns_around(joint) ? M_PI : 0.5 * (joint.upper - joint.lower) + beyond_limits;
  }

  // How far a joint moves any point of a body, the link that it moves or that link's parent [m per rad or m].
  static double reach(const Joint& joint, const CollidingBody& body, bool moves_it) {
    if (joint.type == Joint::Type::prismatic) return 1.0;
    const Isometry3d X = moves_it ? Isometry3d::Identity() : joint.X_parent_body;
    return most_from(Line(X.translation(), X.linear() * joint.axis), body);
  }

  // Unless it is proved already. False if they meet in it.
  bool add(Cell cell) {
    const Isometry3d X_a_over = first_moves_a_ ? first_.X_parent_body_at(cell.centre(0)).inverse()
                                               : first_.X_parent_body_at(cell.centre(0));
    const Isometry3d X_a_b = X_a_over * second_.X_parent_body_at(cell.centre(1));
    const double moved = reach_.dot(cell.half);
    const double far = apart + moved;
    const Distance at_centre =
        distance(*a_.shape, *b_.shape,
                 bullet_pose(a_.X_body_link.inverse() * X_a_b * b_.X_body_link), far, distances_);
    cell.at_least = at_centre.at_least - moved;
    if (at_centre.at_least < far) cells_.push(cell);
    return at_centre.at_most > apart;
  }

  const CollidingBody &a_, &b_;
  const Joint &first_, &second_;
  const bool first_moves_a_;  // as the branches of a tree are moved; else it moves the body between
  const Vector2d reach_;
  std::priority_queue<Cell> cells_;
  int distances_ = 0;
};

}  // namespace

bool TwoJoints::are_within_limits(const RobotModel& model, double q_first,
                                  double q_second) const noexcept {
  return is_within_limits(joint_of(model, first), q_first) &&
         is_within_limits(joint_of(model, second), q_second);
}

std::optional<TwoJoints> two_joints_between(const RobotModel& model, int a, int b) {
  const int over = joint_of(model, b).parent;
  if (over == a) return {};
  if (over >= 0 && joint_of(model, over).parent == a) return TwoJoints{over, b};
  if (a >= 0 && joint_of(model, a).parent == over) return TwoJoints{a, b};
  return {};
}

bool never_meet(const RobotModel& model, const CollidingBody& a, const CollidingBody& b,
                const TwoJoints& joints) {
  return Proof(model, a, b, joints).succeeds();
}

}  // namespace seam
