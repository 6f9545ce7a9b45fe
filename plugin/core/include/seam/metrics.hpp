#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/recording.hpp>

namespace SEAM_API seam {

/// Not measured.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Step of each column of a signal at a time: the difference between its two one-sided limits. A
/// straight line is fitted to the n ticks that end two before the join, another to the n that begin
/// two after it, and both are carried to the join, c = (n + 3)/2 ticks from the middle of each. A
/// step in the signal is found whole. What else is left, at a join on a tick:
///   ½(c² − (n² − 1)/12)·dt² times the change in curvature (n = 3: 4.2 dt²): order 2;
///   a·dt times the change in slope, where the join's time is off by a ticks: order 1;
///   of white noise s√(2/n + 24c²/(n(n² − 1))), if s is its standard deviation (n = 3: 3.1 s; n = 20: 0.7 s).
/// @param time        [s] N, even
/// @param signal      N × columns
/// @param at          [s]
/// @param line_ticks  n ≥ 2; more than 3 for a noisy signal
/// @return            one per column; NaN where the signal does not reach n + 1 ticks to either side
Eigen::VectorXd jump(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal, double at,
                     int line_ticks = 3);

/// Order of a jump in dt: log₂(jump at dt / jump at dt/2). About 0 for a step, 1 for a kink whose time is
/// off, 2 for a smooth signal.
double jump_order(double at_dt, double at_half_dt);

/// What there is to choose in measuring.
struct MetricSettings {
  int line_ticks = 3;         // of `jump`
  double after_join = 0.2;    // [s] in which tracking counts as the join's, or until the next join
  double faded_share = 0.05;  // of its peak, below which a deviation has faded
};

/// What a join does to the torque. NaN: cannot be measured, or not without what was not given.
struct JoinMetrics {
  double time = 0.0;                     // [s]
  int joint = -1;                        // that of torque_jump_nm
  double torque_jump_nm = unknown;       // [N·m] largest |jump| over joints
  double torque_jump_percent = unknown;  // [%] of the joint's effort limit, largest over joints
  /// log₂ of the ratio of torque_jump_nm between dt and dt/2; NaN also where it is rounding alone
  double torque_jump_order = unknown;
  /// [rad/s²] of the reference, largest over joints, in task space over the tool's rx ry rz: as
  /// recorded (exact), else estimated, the `jump` of its acceleration
  double acceleration_jump_rad_s2 = unknown;
  /// [m/s²] likewise, over joints that slide, or the tool's x y z
  double acceleration_jump_m_s2 = unknown;
  /// About what the estimate is off by: a third of what it changes by at twice the tick (it is of order 2 where the
  /// acceleration is smooth), largest over what it is taken of. 0: it is exact.
  double acceleration_jump_error_rad_s2 = unknown;
  double acceleration_jump_error_m_s2 = unknown;  // likewise
  /// [rad] largest |ref − q| over joints, from the join to after_join later
  double tracking_max_rad = unknown;
  double tool_tracking_max_m = unknown;    // [m] likewise, distance of the tool from its reference
  double tool_tracking_max_rad = unknown;  // [rad] likewise, angle between them
  /// [rad] largest |ref − dmp2's ref| over joints, from the join to the next or to the end
  double deviation_peak_rad = unknown;
  /// [s] from the join until that stays below faded_share of its peak; NaN: it does not
  double deviation_faded_s = unknown;
};

/// A whole run. Derivatives are differences between neighbouring ticks, xₖ₊₁ − xₖ over dt: of a
/// step they are its size over dt, or half of that where it falls between ticks, so compare runs of the same dt. NaN as above.
struct RunMetrics {
  std::vector<JoinMetrics> joins;   // one per join, the start included
  double torque_jump_nm = unknown;  // worst over the joins; NaN where one could not be measured
  double torque_jump_percent = unknown;             // likewise
  double torque_jump_order = unknown;               // of the join where torque_jump_nm is largest
  double acceleration_jump_rad_s2 = unknown;        // worst over the joins
  double acceleration_jump_m_s2 = unknown;          // likewise
  double acceleration_jump_error_rad_s2 = unknown;  // likewise
  double acceleration_jump_error_m_s2 = unknown;    // likewise
  double torque_rate_peak_nm_s = unknown;  // [N·m/s] largest |Δtorque|/dt over joints and ticks
  double torque_rate_rms_nm_s = unknown;  // √mean((Δtorque/dt)²) of the joint where it is largest
  double jerk_peak_rad_s3 = unknown;      // [rad/s³] of the reference acceleration, likewise
  double jerk_rms_rad_s3 = unknown;       // likewise
  double tracking_max_rad = unknown;      // [rad] largest |ref − q| over joints and ticks
  double tracking_rms_rad = unknown;      // √mean(|ref − q|²) of the joint where it is largest
  double tracking_after_join_max_rad = unknown;  // worst over the joins
  double tool_tracking_max_m = unknown;    // [m] largest distance of the tool from its reference
  double tool_tracking_rms_m = unknown;    // √mean of its square
  double tool_tracking_max_rad = unknown;  // [rad] likewise, angle of the rotation between them
  double tool_tracking_rms_rad = unknown;  // √mean of its square
  double tool_tracking_after_join_max_m = unknown;    // worst over the joins
  double tool_tracking_after_join_max_rad = unknown;  // likewise
  /// Share of the ticks in which a joint's commanded |torque| ≥ its effort limit
  double saturated_share = unknown;
  /// [rad] largest |ref − dmp2's ref| over joints and ticks: the price of smoothness
  double deviation_peak_rad = unknown;
  double deviation_peak_m = unknown;  // [m] likewise, distance of the tool's references
  /// [s] from the last join before deviation_peak_rad until the deviation stays below faded_share
  /// of it to the end; NaN: it does not
  double deviation_faded_s = unknown;
};

/// Other recordings of the same run, for what one alone does not tell.
struct Companions {
  const Recording* half = nullptr;  // at dt/2: gives the orders
  const Recording* dmp2 = nullptr;  // with dmp2, at the same dt: gives the deviations
};

/// Measures what a recording has columns for; the rest is NaN.
/// @throws Error  a recording that is not valid, fewer than 2 ticks, settings that will not do, a companion that has another tick or other joins (half),
///                other times, joints or coordinates (dmp2)
RunMetrics measure(const Recording& recording, const Companions& companions = {},
                   const MetricSettings& settings = {});

}  // namespace seam
