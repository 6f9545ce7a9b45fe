#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include <seam/robot_model.hpp>

namespace seam {

class Object;
class Robot;
class YamlEntry;
struct Scene;

/// A box or a ball that stands in the arm's way, or moves on a straight line whatever it meets.
struct SolidObstacle {
  Geometry shape;                                 // about its middle; boxes stand level
  Eigen::Vector3d at = Eigen::Vector3d::Zero();   // [m] in the world, its middle to begin with
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  // [m] on which it goes
  double leaves = 0.0;                            // [s] since the run began
  double over = 0.0;                              // [s] until it has gone its way; 0: it stands

  /// Its middle at a time [s]; between rest and rest by a quintic (minimum jerk).
  Eigen::Vector3d position(double time) const;
};

/// The key `obstacles` of a scene (see scenes/README.md).
/// @throws Error  names file, line and key
std::vector<SolidObstacle> read_obstacles(const YamlEntry& entry);

/// All of a scene's obstacles, in the robot's world as kinematic objects that nothing meets: what would touch is measured and
/// not pushed. Each tick Bullet's contact test between each of them and the robot's colliders gives their distance, negative by
/// the depth where they penetrate. Outcomes: `touched_share`, the share of ticks in which it is not positive, and
/// `obstacle_distance_m`, the least of all, of which more is better. Meshes count as the hulls that they
/// collide as (see RobotSettings), and edges are round by Bullet's margin of 1 mm.
/// @param robot  its world must outlive them
std::unique_ptr<Object> make_obstacles(const Scene& scene, Robot& robot);

}  // namespace seam
