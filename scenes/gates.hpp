#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

namespace seam {

class Object;
class Robot;
class YamlEntry;
struct Scene;

/// A narrow square frame for the tool to pass. It is seen, and nothing touches it.
struct Gate {
  /// Pose of its middle in the world: x is the direction of passage, y is level.
  Eigen::Isometry3d X_world_gate = Eigen::Isometry3d::Identity();
  double opening = 0.06;  // [m] edge of the square
};

/// How a point passes a gate: the distance that it keeps from the frame where it crosses the gate's plane,
///     opening/2 − max(|y|, |z|),
/// with y and z in the gate's frame, on the straight line between the places before and after. Where it crosses more often, in
/// the gate's direction, its best passage counts. Negative: it crosses beside the opening.
class Passage {
 public:
  explicit Passage(const Gate& gate) : gate_(gate) {}

  /// The point's next place in the world [m].
  void go_to(const Eigen::Vector3d& place);
  /// [m] −opening for a gate that was never crossed in its direction.
  double clearance() const;

 private:
  Gate gate_;
  std::optional<Eigen::Vector3d> last_;  // place, in the gate's frame
  double best_ = -std::numeric_limits<double>::infinity();
};

/// The key `gates` of a scene (see scenes/README.md).
/// @throws Error  names file, line and key
std::vector<Gate> read_gates(const YamlEntry& entry);

/// All of a scene's gates, and, if the tool's point is off its link, a thin rod from one to the other, to be seen. Outcome: `clearance_m`, the least of their clearances for the scene's tool; more is better.
std::unique_ptr<Object> make_gates(const Scene& scene, const Robot& robot);

}  // namespace seam
