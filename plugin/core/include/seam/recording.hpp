#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace seam {

/// A join in a recording.
struct RecordedJoin {
  double time = 0.0;               // [s]
  int primitive = 0;               // index of the one that took over; 0 is the start
  double acceleration_jump = 0.0;  // [rad/s²] largest over coordinates, exact one-sided values
};

/// What a run on a robot with n joints left behind: one row per tick, the state before the tick and
/// the torque commanded for it. SI units.
struct Recording {
  std::vector<std::string> joints;        // n
  Eigen::VectorXd effort;                 // [N·m] n, limits of the joints
  Eigen::VectorXd time;                   // [s] N
  Eigen::VectorXi running;                // N, index of the running primitive, -1 before the first
  Eigen::MatrixXd ref, ref_vel, ref_acc;  // N × n, joint reference
  Eigen::MatrixXd q, qd;                  // N × n
  Eigen::MatrixXd torque;                 // N × n [N·m]
  std::vector<RecordedJoin> joins;

  Recording() = default;
  /// Room for a number of ticks; nothing allocates afterwards.
  Recording(std::vector<std::string> joint_names, Eigen::VectorXd effort_limits, int ticks);

  int ticks() const { return static_cast<int>(time.size()); }
  double dt() const { return time(1) - time(0); }  // [s]

  /// Writes the table as CSV: time, switch, ref.<j>, ref_vel.<j>, ref_acc.<j>, q.<j>, qd.<j>,
  /// torque.<j>.
  /// @throws Error  cannot be written
  void write(const std::string& path) const;
};

}  // namespace seam
