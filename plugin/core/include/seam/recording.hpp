#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace seam {

/// A join in a recording.
struct RecordedJoin {
  double time = 0.0;               // [s]
  int primitive = 0;               // index of the one that took over; 0 is the start
  double acceleration_jump = 0.0;  // [rad/s²] largest over angles, exact one-sided values
  double linear_jump = 0.0;        // [m/s²] likewise, over the tool's x y z
};

/// Something else that was recorded at every tick; the name carries its unit.
struct Signal {
  std::string name;
  Eigen::VectorXd values;  // N
};

/// What came of a run as a whole; the name is a metric's and carries its unit.
struct Outcome {
  std::string name;
  double value;
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

  // In task space alone.
  std::vector<std::string> coordinates;          // D: x y z [m], rx ry rz [rad]
  Eigen::MatrixXd tool_ref, tool_vel, tool_acc;  // N × D
  Eigen::VectorXd tool_error_m, tool_error_rad;  // N, of the tool from its reference

  std::vector<Signal> signals;
  std::vector<Outcome> outcomes;

  Recording() = default;
  /// Room for a number of ticks; nothing allocates afterwards.
  /// @param tool_coordinates  D, none in joint space
  Recording(std::vector<std::string> joint_names, Eigen::VectorXd effort_limits, int ticks,
            std::vector<std::string> tool_coordinates = {});

  int ticks() const { return static_cast<int>(time.size()); }
  double dt() const { return time(1) - time(0); }  // [s]

  /// A join at a time [s], its acceleration jumps estimated from ref_acc (see jump), NaN where that cannot be.
  RecordedJoin estimated_join(double at, int primitive) const;

  bool in_task_space() const { return !coordinates.empty(); }

  /// Reads what `write` writes, or any CSV with `time` [s] first, at even ticks, and torque.<j> for each joint; of the
  /// other columns each kind is there for all joints or for none, and is then empty. Columns of other names
  /// become signals. A join is where `switch` changes (see estimated_join); without `switch` there is none. Effort limits are not in the file: NaN.
  /// @throws Error  names the file, and the line or the column
  static Recording read(const std::string& path);
  /// Writes the table as CSV: time, switch, ref.<j>, ref_vel.<j>, ref_acc.<j>, q.<j>, qd.<j>,
  /// torque.<j>; in task space also ref.<c>, ref_vel.<c>, ref_acc.<c>, tool_error_m, tool_error_rad; the signals.
  /// @throws Error  cannot be written
  void write(const std::string& path) const;
};

}  // namespace seam
