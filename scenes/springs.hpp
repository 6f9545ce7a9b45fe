#pragma once

#include <vector>

#include <Eigen/Core>

#include <seam/inverse_dynamics.hpp>
#include <seam/join.hpp>
#include <seam/recording.hpp>
#include <seam/robot.hpp>

namespace seam {

/// Watches the springs of an arm's elastic joints: by how much what they bear swings about what the motion asks of them.
class Springs {
 public:
  /// @param robot  stands where the scene begins, and must outlive this
  Springs(const Robot& robot, int ticks);

  /// Before a tick.
  void look(Eigen::Index tick) noexcept;
  /// After it, with the joints' reference at its beginning; joints that it does not have (a liquid's) do not accelerate.
  void compare(Eigen::Index tick, const Sample& reference) noexcept;
  /// Adds the outcomes `ringing_nm`, half of the widest swing of a spring's torque in the 0.2 s after a join, less the parabola that fits
  /// it best there; and `resonance_hz` of the slowest joint, √(k/J + k·W)/2π with its share W of the inverse of M + J (of the
  /// other joints) at the start.
  void finish(Recording& recording) const;

 private:
  const Robot& robot_;
  InverseDynamics dynamics_;
  std::vector<int> joints_;  // that are elastic
  Eigen::MatrixXd
      beyond_;  // tick × joint [N·m or N] what a spring bears beyond what the motion asks
  Eigen::VectorXd q_, qd_, theta_, w_, qdd_, needed_;
  double resonance_;  // [Hz]
};

}  // namespace seam
