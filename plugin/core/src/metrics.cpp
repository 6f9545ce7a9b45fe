#include <algorithm>
#include <cmath>

#include <seam/error.hpp>
#include <seam/metrics.hpp>

namespace seam {

namespace {

constexpr int line_ticks = 3;
constexpr int gap_ticks = 2;
constexpr double same_time = 1e-9;  // [s]

// The least-squares line through three even ticks from `first` on, at a time.
Eigen::RowVectorXd line_at(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal,
                           Eigen::Index first, double at) {
  const auto rows = signal.middleRows(first, line_ticks);
  const Eigen::RowVectorXd slope = (rows.row(2) - rows.row(0)) / (time(first + 2) - time(first));
  return rows.colwise().mean() + slope * (at - time(first + 1));
}

// The first tick at a time or later.
Eigen::Index tick_at(const Eigen::VectorXd& time, double at) {
  const double dt = time(1) - time(0);
  return static_cast<Eigen::Index>(std::ceil((at - time(0)) / dt - 1e-6));
}

Eigen::MatrixXd rate(const Eigen::MatrixXd& signal, double dt) {
  return (signal.bottomRows(signal.rows() - 1) - signal.topRows(signal.rows() - 1)) / dt;
}

double peak(const Eigen::MatrixXd& signal) {
  return signal.size() == 0 ? unknown : signal.cwiseAbs().maxCoeff();
}

double worst_rms(const Eigen::MatrixXd& signal) {
  return signal.size() == 0 ? unknown
                            : std::sqrt(signal.array().square().colwise().mean().maxCoeff());
}

// NaN where one is: what could not be measured is not reported as good.
double worst(const std::vector<JoinMetrics>& joins, double JoinMetrics::*metric) {
  double worst = joins.empty() ? 0.0 : joins.front().*metric;
  for (const JoinMetrics& join : joins)
    worst = std::isnan(worst) || std::isnan(join.*metric) ? unknown : std::max(worst, join.*metric);
  return worst;
}

Eigen::MatrixXd tracking_error(const Recording& recording) {
  const bool has_both = recording.ref.size() > 0 && recording.q.size() > 0;
  return has_both ? Eigen::MatrixXd(recording.ref - recording.q) : Eigen::MatrixXd();
}

double tracking_after(const Recording& recording, std::size_t join) {
  const double from = recording.joins[join].time;
  double to = from + after_join;
  if (join + 1 < recording.joins.size()) to = std::min(to, recording.joins[join + 1].time);
  const Eigen::Index N = recording.ticks();
  const Eigen::Index first = std::min(std::max<Eigen::Index>(tick_at(recording.time, from), 0), N);
  const Eigen::Index last = std::min(tick_at(recording.time, to) + 1, N);
  const Eigen::MatrixXd error = tracking_error(recording);
  return error.size() == 0 || last <= first ? unknown : peak(error.middleRows(first, last - first));
}

void measure_torque_jump(const Recording& recording, JoinMetrics& metrics) {
  const Eigen::VectorXd size = jump(recording.time, recording.torque, metrics.time).cwiseAbs();
  if (size.size() == 0 || !size.allFinite()) return;
  metrics.torque_jump_nm = size.maxCoeff(&metrics.joint);
  const bool limits_known = !recording.effort.array().isNaN().any();
  if (limits_known)
    metrics.torque_jump_percent = 100.0 * size.cwiseQuotient(recording.effort).maxCoeff();
}

std::vector<JoinMetrics> measure_joins(const Recording& recording) {
  std::vector<JoinMetrics> joins;
  for (std::size_t i = 0; i < recording.joins.size(); ++i) {
    JoinMetrics& metrics = joins.emplace_back();
    metrics.time = recording.joins[i].time;
    metrics.acceleration_jump_rad_s2 = recording.joins[i].acceleration_jump;
    metrics.acceleration_jump_m_s2 = recording.joins[i].linear_jump;
    metrics.tracking_max_rad = tracking_after(recording, i);
    measure_torque_jump(recording, metrics);
  }
  return joins;
}

double share_saturated(const Recording& recording) {
  if (recording.torque.size() == 0 || recording.effort.array().isNaN().any()) return unknown;
  int saturated = 0;
  for (Eigen::Index k = 0; k < recording.ticks(); ++k)
    saturated +=
        (recording.torque.row(k).transpose().cwiseAbs().array() >= recording.effort.array()).any();
  return static_cast<double>(saturated) / recording.ticks();
}

void measure_tool(const Recording& recording, RunMetrics& metrics) {
  metrics.tool_tracking_max_m = peak(recording.tool_error_m);
  metrics.tool_tracking_rms_m = worst_rms(recording.tool_error_m);
  metrics.tool_tracking_max_rad = peak(recording.tool_error_rad);
  metrics.tool_tracking_rms_rad = worst_rms(recording.tool_error_rad);
}

void measure_orders(const Recording& half, RunMetrics& metrics) {
  const std::vector<JoinMetrics> finer = measure_joins(half);
  bool same = finer.size() == metrics.joins.size();
  for (std::size_t i = 0; same && i < finer.size(); ++i)
    same = std::abs(finer[i].time - metrics.joins[i].time) <= half.dt() + same_time;
  if (!same) throw Error("order", "the run at half the tick has other joins");
  for (std::size_t i = 0; i < finer.size(); ++i) {
    JoinMetrics& join = metrics.joins[i];
    join.torque_jump_order = jump_order(join.torque_jump_nm, finer[i].torque_jump_nm);
    if (join.torque_jump_nm == metrics.torque_jump_nm)
      metrics.torque_jump_order = join.torque_jump_order;
  }
}

double fading_time(const Recording& recording, const Eigen::VectorXd& deviation) {
  Eigen::Index at = 0;
  const double peak = deviation.maxCoeff(&at);
  if (peak == 0.0) return 0.0;
  Eigen::Index last = recording.ticks() - 1;
  while (deviation(last) <= faded_share * peak) --last;
  if (last == recording.ticks() - 1) return unknown;
  double joined = recording.time(0);
  for (const RecordedJoin& join : recording.joins)
    if (join.time <= recording.time(at)) joined = std::max(joined, join.time);
  return recording.time(last + 1) - joined;
}

void measure_deviation(const Recording& recording, const Recording& dmp2, RunMetrics& metrics) {
  if (recording.ref.rows() != dmp2.ref.rows() || recording.ref.cols() != dmp2.ref.cols() ||
      recording.tool_ref.rows() != dmp2.tool_ref.rows() ||
      recording.tool_ref.cols() != dmp2.tool_ref.cols())
    throw Error("deviation", "the two runs differ in ticks, joints or coordinates");
  if (recording.ref.size() > 0) {
    const Eigen::MatrixXd joints = recording.ref - dmp2.ref;
    metrics.deviation_peak_rad = peak(joints);
    metrics.deviation_faded_s = fading_time(recording, joints.cwiseAbs().rowwise().maxCoeff());
  }
  if (recording.tool_ref.size() > 0)
    metrics.deviation_peak_m =
        (recording.tool_ref - dmp2.tool_ref).leftCols<3>().rowwise().norm().maxCoeff();
}

}  // namespace

Eigen::VectorXd jump(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal, double at) {
  const Eigen::Index tick = tick_at(time, at);
  const Eigen::Index before = tick - gap_ticks - line_ticks + 1;
  const Eigen::Index after = tick + gap_ticks;
  if (before < 0 || after + line_ticks > time.size())
    return Eigen::VectorXd::Constant(signal.cols(), unknown);
  return line_at(time, signal, after, at) - line_at(time, signal, before, at);
}

double jump_order(double at_dt, double at_half_dt) {
  return std::log2(at_dt / at_half_dt);
}

RunMetrics measure(const Recording& recording, const Companions& companions) {
  if (recording.ticks() < 2) throw Error("recording", "fewer than 2 ticks");
  RunMetrics metrics;
  metrics.joins = measure_joins(recording);
  metrics.torque_jump_nm = worst(metrics.joins, &JoinMetrics::torque_jump_nm);
  metrics.torque_jump_percent = worst(metrics.joins, &JoinMetrics::torque_jump_percent);
  metrics.acceleration_jump_rad_s2 = worst(metrics.joins, &JoinMetrics::acceleration_jump_rad_s2);
  metrics.acceleration_jump_m_s2 = worst(metrics.joins, &JoinMetrics::acceleration_jump_m_s2);
  metrics.tracking_after_join_max_rad = worst(metrics.joins, &JoinMetrics::tracking_max_rad);
  const Eigen::MatrixXd torque_rate = rate(recording.torque, recording.dt());
  const bool has_acceleration = recording.ref_acc.size() > 0;
  const Eigen::MatrixXd jerk =
      has_acceleration ? rate(recording.ref_acc, recording.dt()) : Eigen::MatrixXd();
  const Eigen::MatrixXd error = tracking_error(recording);
  metrics.torque_rate_peak_nm_s = peak(torque_rate);
  metrics.torque_rate_rms_nm_s = worst_rms(torque_rate);
  metrics.jerk_peak_rad_s3 = peak(jerk);
  metrics.jerk_rms_rad_s3 = worst_rms(jerk);
  metrics.tracking_max_rad = peak(error);
  metrics.tracking_rms_rad = worst_rms(error);
  metrics.saturated_share = share_saturated(recording);
  measure_tool(recording, metrics);
  if (companions.half) measure_orders(*companions.half, metrics);
  if (companions.dmp2) measure_deviation(recording, *companions.dmp2, metrics);
  return metrics;
}

}  // namespace seam
