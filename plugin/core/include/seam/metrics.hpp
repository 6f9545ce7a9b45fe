#pragma once

#include <vector>

#include <Eigen/Core>

#include <seam/recording.hpp>

namespace seam {

/// Step of each column of a signal at a time: the difference between its two one-sided limits. A
/// straight line is fitted to the three ticks that end two before the join, another to the three
/// that begin two after it, and both are carried to the join. A step in the signal is found whole;
/// a continuous signal leaves an error of order dt².
/// @param time    [s] N, even
/// @param signal  N × n
/// @param at      [s]
/// @return        n; NaN where the signal does not reach four ticks to either side
Eigen::VectorXd jump(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal, double at);

/// Order of a jump in dt: log₂(jump at dt / jump at dt/2). About 0 for a step, 2 for a smooth
/// signal.
double jump_order(double at_dt, double at_half_dt);

/// What a join does to the torque.
struct JoinMetrics {
  double time = 0.0;                      // [s]
  double torque_jump_nm = 0.0;            // [N·m] largest over joints
  double torque_jump_percent = 0.0;       // [%] of the joint's effort limit, largest over joints
  double acceleration_jump_rad_s2 = 0.0;  // [rad/s²] of the reference, exact one-sided values
  double acceleration_jump_m_s2 = 0.0;    // [m/s²] likewise, of a tool's x y z
};

/// A whole run. Derivatives are differences between neighbouring ticks.
struct RunMetrics {
  std::vector<JoinMetrics> joins;
  double torque_jump_nm = 0.0;  // worst over the joins
  double torque_jump_percent = 0.0;
  double acceleration_jump_rad_s2 = 0.0;
  double acceleration_jump_m_s2 = 0.0;
  double torque_rate_peak_nm_s = 0.0;  // [N·m/s] largest |Δtorque|/dt over joints and ticks
  double torque_rate_rms_nm_s = 0.0;   // root mean square, of the joint where it is largest
  double jerk_peak_rad_s3 = 0.0;       // [rad/s³] of the reference acceleration, likewise
  double jerk_rms_rad_s3 = 0.0;
  double tracking_max_rad = 0.0;  // [rad] largest |ref − q|
  double tracking_rms_rad = 0.0;  // of the joint where it is largest
  double tool_tracking_max_m =
      0.0;  // [m] largest distance of the tool from its reference; task space alone
  double tool_tracking_max_rad = 0.0;  // [rad] likewise
};

JoinMetrics measure(const Recording& recording, const RecordedJoin& join);
RunMetrics measure(const Recording& recording);

/// Largest distance [rad] between the references of two runs of the same length.
/// @throws Error  the runs differ in ticks or joints
double deviation_peak(const Recording& run, const Recording& other);

/// Largest distance [m] between the tool's references of two runs in task space, of the same length.
/// @throws Error  the runs differ in ticks, or one is not in task space
double tool_deviation_peak(const Recording& run, const Recording& other);

}  // namespace seam
