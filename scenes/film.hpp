#pragma once

#include <memory>
#include <vector>

#include "scenes/object.hpp"
#include "scenes/replay.hpp"

namespace seam {

/// Makes a replay while a run is played. All that it is given must outlive it.
class Film {
 public:
  Film(const Scene& scene, Join method, const Robot& robot,
       const std::vector<std::unique_ptr<Object>>& objects, double dt, int ticks, Replay& replay);

  /// To be called before each of Bullet's ticks, after the objects' own.
  void pre_tick(int tick);
  /// After the last tick.
  void finish(const Recording& recording);

 private:
  int tick_of(Eigen::Index frame) const;
  void take();

  const Scene& scene_;
  const Robot& robot_;
  const std::vector<std::unique_ptr<Object>>& objects_;
  Replay& replay_;
  std::vector<Frame> bodies_;
  Frame tool_;
  double dt_;
  Eigen::Index next_ = 0;  // frame
};

}  // namespace seam
