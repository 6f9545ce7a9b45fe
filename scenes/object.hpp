#pragma once

#include <memory>
#include <vector>

#include "scenes/replay.hpp"
#include "scenes/scene.hpp"
#include <seam/recording.hpp>
#include <seam/robot.hpp>

namespace seam {

/// Something in a scene beside the robot: what it does before each tick, and what it adds, if anything, to the recording
/// and the replay.
class Object {
 public:
  virtual ~Object() = default;
  /// @param time  [s] since the run began
  virtual void pre_tick(Eigen::Index tick, double time) = 0;
  /// Adds its parts, before the first tick, and says where they are; `film` follows a tick's `pre_tick`.
  virtual void appear(Replay&) {}
  virtual void film(Eigen::Index /*frame*/, Replay&) const {}
  /// After the last tick.
  virtual void finish(Recording&) const {}
};

/// What a scene has of them.
/// @param robot   stands where the scene begins, and must outlive them
/// @param ticks   of the run, each of dt [s]
/// @param place   index of the glass's place
std::vector<std::unique_ptr<Object>> make_objects(const Scene& scene, Robot& robot, int ticks,
                                                  double dt, std::size_t place);

}  // namespace seam
