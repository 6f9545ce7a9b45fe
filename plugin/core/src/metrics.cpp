#include <cmath>
#include <limits>

#include <seam/error.hpp>
#include <seam/metrics.hpp>

namespace seam {

namespace {

constexpr int line_ticks = 3;
constexpr int gap_ticks = 2;

// The least-squares line through three even ticks from `first` on, at a time.
Eigen::RowVectorXd line_at(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal,
                           Eigen::Index first, double at) {
  const auto rows = signal.middleRows(first, line_ticks);
  const Eigen::RowVectorXd slope = (rows.row(2) - rows.row(0)) / (time(first + 2) - time(first));
  return rows.colwise().mean() + slope * (at - time(first + 1));
}

Eigen::MatrixXd rate(const Eigen::MatrixXd& signal, double dt) {
  return (signal.bottomRows(signal.rows() - 1) - signal.topRows(signal.rows() - 1)) / dt;
}

double peak(const Eigen::MatrixXd& signal) {
  return signal.cwiseAbs().maxCoeff();
}

// NaN where either is: what could not be measured is not reported as good.
double worse(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

double worst_rms(const Eigen::MatrixXd& signal) {
  return std::sqrt(signal.array().square().colwise().mean().maxCoeff());
}

}  // namespace

Eigen::VectorXd jump(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal, double at) {
  const double dt = time(1) - time(0);
  const auto tick = static_cast<Eigen::Index>(std::ceil((at - time(0)) / dt - 1e-6));
  const Eigen::Index before = tick - gap_ticks - line_ticks + 1;
  const Eigen::Index after = tick + gap_ticks;
  if (before < 0 || after + line_ticks > time.size())
    return Eigen::VectorXd::Constant(signal.cols(), std::numeric_limits<double>::quiet_NaN());
  return line_at(time, signal, after, at) - line_at(time, signal, before, at);
}

double jump_order(double at_dt, double at_half_dt) {
  return std::log2(at_dt / at_half_dt);
}

JoinMetrics measure(const Recording& recording, const RecordedJoin& join) {
  const Eigen::VectorXd torque_jump = jump(recording.time, recording.torque, join.time).cwiseAbs();
  JoinMetrics metrics;
  metrics.time = join.time;
  metrics.torque_jump_nm = torque_jump.maxCoeff();
  metrics.torque_jump_percent = 100.0 * torque_jump.cwiseQuotient(recording.effort).maxCoeff();
  metrics.acceleration_jump_rad_s2 = join.acceleration_jump;
  metrics.acceleration_jump_m_s2 = join.linear_jump;
  return metrics;
}

RunMetrics measure(const Recording& recording) {
  if (recording.ticks() < 2) throw Error("recording", "fewer than 2 ticks");
  RunMetrics metrics;
  for (const RecordedJoin& join : recording.joins) {
    const JoinMetrics& at = metrics.joins.emplace_back(measure(recording, join));
    metrics.torque_jump_nm = worse(metrics.torque_jump_nm, at.torque_jump_nm);
    metrics.torque_jump_percent = worse(metrics.torque_jump_percent, at.torque_jump_percent);
    metrics.acceleration_jump_rad_s2 =
        worse(metrics.acceleration_jump_rad_s2, at.acceleration_jump_rad_s2);
    metrics.acceleration_jump_m_s2 =
        worse(metrics.acceleration_jump_m_s2, at.acceleration_jump_m_s2);
  }
  const Eigen::MatrixXd torque_rate = rate(recording.torque, recording.dt());
  const Eigen::MatrixXd jerk = rate(recording.ref_acc, recording.dt());
  const Eigen::MatrixXd error = recording.ref - recording.q;
  metrics.torque_rate_peak_nm_s = peak(torque_rate);
  metrics.torque_rate_rms_nm_s = worst_rms(torque_rate);
  metrics.jerk_peak_rad_s3 = peak(jerk);
  metrics.jerk_rms_rad_s3 = worst_rms(jerk);
  metrics.tracking_max_rad = peak(error);
  metrics.tracking_rms_rad = worst_rms(error);
  if (!recording.in_task_space()) return metrics;
  metrics.tool_tracking_max_m = recording.tool_error_m.maxCoeff();
  metrics.tool_tracking_max_rad = recording.tool_error_rad.maxCoeff();
  return metrics;
}

double deviation_peak(const Recording& run, const Recording& other) {
  if (run.ref.rows() != other.ref.rows() || run.ref.cols() != other.ref.cols())
    throw Error("deviation", "the two runs differ in ticks or joints");
  return peak(run.ref - other.ref);
}

double tool_deviation_peak(const Recording& run, const Recording& other) {
  if (!run.in_task_space() || !other.in_task_space() || run.ticks() != other.ticks())
    throw Error("deviation", "the two runs differ in ticks, or are not both in task space");
  return (run.tool_ref - other.tool_ref).leftCols<3>().rowwise().norm().maxCoeff();
}

}  // namespace seam
