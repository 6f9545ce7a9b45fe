#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// A join in a recording.
struct RecordedJoin {
  double time = 0.0;  // [s]
  int primitive = 0;  // index of the one that took over; 0 is the start
  /// [rad/s²] largest over angles, exact one-sided values; NaN: not known
  double acceleration_jump = std::numeric_limits<double>::quiet_NaN();
  /// [m/s²] likewise, over the tool's x y z and joints that slide
  double linear_jump = std::numeric_limits<double>::quiet_NaN();
};

/// Something else that was recorded at every tick; the name carries its unit.
struct Signal {
  std::string name;        // of its column
  Eigen::VectorXd values;  // N
};

/// What came of a run as a whole; the name is a metric's and carries its unit.
struct Outcome {
  std::string name;             // as in `poured_share`
  double value;                 // in the unit that the name carries
  bool more_is_better = false;  // else less is
};

/// What a run on a robot with n joints left behind: one row per tick, the state before the tick and
/// the torque commanded for it. SI units.
struct Recording {
  std::vector<std::string> joints;  // n names
  std::vector<bool>
      slides;              // n, whose columns are in m and N instead of rad and N·m; empty: none's
  Eigen::VectorXd effort;  // [N·m] n, limits of the joints
  Eigen::VectorXd time;    // [s] N
  Eigen::VectorXi running;          // N, index of the running primitive, -1 before the first
  Eigen::MatrixXd ref;              // N × n, the joints' reference
  Eigen::MatrixXd ref_vel;          // N × n, per second
  Eigen::MatrixXd ref_acc;          // N × n, per second squared
  Eigen::MatrixXd q;                // N × n, where the joints are
  Eigen::MatrixXd qd;               // N × n, per second
  Eigen::MatrixXd torque;           // N × n [N·m]
  std::vector<RecordedJoin> joins;  // in their order

  // In task space alone.
  std::vector<std::string> coordinates;  // D: x y z [m], rx ry rz [rad]
  Eigen::MatrixXd tool_ref;              // N × D, the tool's reference
  Eigen::MatrixXd tool_vel;              // N × D, per second
  Eigen::MatrixXd tool_acc;              // N × D, per second squared
  Eigen::VectorXd tool_error_m;          // N, distance of the tool from its reference
  Eigen::VectorXd tool_error_rad;        // N, angle likewise

  std::vector<Signal> signals;    // what else was recorded
  std::vector<Outcome> outcomes;  // what came of the run
  std::string
      incident;  // what kept the arm from following its sequence, in one line; empty: nothing
  std::string source = "recording";  // where it is from (a file's path), for messages

  Recording() = default;
  /// Room for a number of ticks; nothing allocates afterwards.
  /// @param tool_coordinates  D, none in joint space
  Recording(std::vector<std::string> joint_names, Eigen::VectorXd effort_limits, int ticks,
            std::vector<std::string> tool_coordinates = {});

  int ticks() const { return static_cast<int>(time.size()); }  // N
  /// [s] mean; a clock that is written with few digits is uneven in the last.
  double dt() const { return (time(time.size() - 1) - time(0)) / (ticks() - 1); }

  bool slides_at(std::size_t joint) const {
    return joint < slides.size() && slides[joint];
  }  // joint by joint
  /// Whether there is a tool's reference.
  bool in_task_space() const { return !coordinates.empty(); }

  /// @throws Error  names what has other sizes than `time`, `joints` and `coordinates` say
  void validate() const;
  /// Reads what `write` writes, or any CSV with `time` [s] first, at even ticks. Joints are those of the columns
  /// torque.<j>, q.<j>, qd.<j>, else those of ref.<j>; each kind of column is there for all of them or for none, and is then
  /// empty. ref.<c> of x y z, or of x y z rx ry rz, that are no joints make it a recording in task space. Columns of other
  /// names become signals. Joints x, y and z slide. A join is where `switch` changes, at its first new tick; a change of goal or τ does not show
  /// there. The joins' acceleration jumps and the joints' effort limits are not in the file: NaN.
  /// @throws Error  names the file, the line or the column, and what would be right
  static Recording read(const std::string& path);
  /// Writes the table as CSV. Columns: time, switch, ref.<j>, ref_vel.<j>, ref_acc.<j>, q.<j>, qd.<j>,
  /// torque.<j>; in task space also ref.<c>, ref_vel.<c>, ref_acc.<c>, tool_error_m, tool_error_rad; the signals.
  /// @throws Error  not valid, or cannot be written
  void write(const std::string& path) const;
};

}  // namespace seam
