#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "shown.hpp"
#include <seam/error.hpp>
#include <seam/metrics.hpp>

namespace seam {

namespace {

constexpr int gap_ticks = 2;
constexpr double same_tick = 1e-2;      // share of a tick that a written clock may be off by
constexpr double no_deviation = 1e-12;  // [rad] rounding

// The least-squares line through n even ticks from `first` on, at a time.
Eigen::RowVectorXd line_at(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal,
                           Eigen::Index first, int n, double at) {
  const auto rows = signal.middleRows(first, n);
  const double middle = 0.5 * (time(first) + time(first + n - 1));
  const Eigen::RowVectorXd from_middle = (time.segment(first, n).array() - middle).transpose();
  const Eigen::RowVectorXd slope = from_middle * rows / from_middle.squaredNorm();
  return rows.colwise().mean() + slope * (at - middle);
}

// The first tick at a time or later; as many as there are if there is none.
Eigen::Index tick_at(const Eigen::VectorXd& time, double at) {
  const double slack = 1e-6 * (time(1) - time(0));
  return std::lower_bound(time.begin(), time.end(), at - slack) - time.begin();
}

Eigen::MatrixXd rate(const Eigen::MatrixXd& signal, double dt) {
  if (signal.size() == 0) return {};
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
  double worst = joins.empty() ? unknown : joins.front().*metric;
  for (const JoinMetrics& join : joins)
    worst = std::isnan(worst) || std::isnan(join.*metric) ? unknown : std::max(worst, join.*metric);
  return worst;
}

Eigen::MatrixXd tracking_error(const Recording& recording) {
  const bool has_both = recording.ref.size() > 0 && recording.q.size() > 0;
  return has_both ? Eigen::MatrixXd(recording.ref - recording.q) : Eigen::MatrixXd();
}

// The first tick from a join on, and the first of the next join or the end.
std::pair<Eigen::Index, Eigen::Index> until_next_join(const Recording& recording,
                                                      const RecordedJoin& join) {
  const Eigen::Index first = tick_at(recording.time, join.time);
  Eigen::Index end = recording.ticks();
  for (const RecordedJoin& other : recording.joins)
    if (const Eigen::Index next = tick_at(recording.time, other.time); next > first)
      end = std::min(end, next);
  return {first, end};
}

// The largest value from a join on for a while, at most until the next join.
double peak_after(const Recording& recording, const RecordedJoin& join, double duration,
                  const Eigen::MatrixXd& signal) {
  auto [first, end] = until_next_join(recording, join);
  end = std::min(end, tick_at(recording.time, join.time + duration) + 1);
  return signal.size() == 0 || first >= end ? unknown : peak(signal.middleRows(first, end - first));
}

bool limits_known(const Recording& recording) {
  return recording.effort.size() == recording.torque.cols() &&
         !recording.effort.array().isNaN().any();
}

void measure_torque_jump(const Recording& recording, int line_ticks, JoinMetrics& metrics) {
  const Eigen::VectorXd size =
      jump(recording.time, recording.torque, metrics.time, line_ticks).cwiseAbs();
  if (size.size() == 0 || !size.allFinite()) return;
  metrics.torque_jump_nm = size.maxCoeff(&metrics.joint);
  if (limits_known(recording))
    metrics.torque_jump_percent = 100.0 * size.cwiseQuotient(recording.effort).maxCoeff();
}

// The signal at every other tick, so that the first one from `at` on is among them.
Eigen::MatrixXd every_other(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal, double at) {
  const Eigen::Index first = tick_at(time, at) % 2;
  const Eigen::Index rows = (signal.rows() - first + 1) / 2;
  return signal(Eigen::seqN(first, rows, 2), Eigen::all);
}

// A signal's step, and about what that is off by.
struct Estimate {
  double size = unknown, error = unknown;
};

Estimate estimated_jump(const Recording& recording, const Eigen::MatrixXd& signal, double at,
                        int n) {
  if (signal.size() == 0) return {};
  const Eigen::VectorXd fine = jump(recording.time, signal, at, n);
  const Eigen::VectorXd coarse = jump(every_other(recording.time, recording.time, at),
                                      every_other(recording.time, signal, at), at, n);
  return {peak(fine), peak((coarse - fine) / 3.0)};
}

// Of the tool's coordinates or, without a tool, of the joints: those in m/s², or those in rad/s².
Eigen::MatrixXd accelerations(const Recording& recording, bool linear) {
  const bool tool = recording.in_task_space() && recording.tool_acc.cols() >= 3;
  const Eigen::MatrixXd& all = tool ? recording.tool_acc : recording.ref_acc;
  std::vector<Eigen::Index> columns;
  for (Eigen::Index c = 0; c < all.cols(); ++c)
    if ((tool ? c < 3 : recording.slides_at(static_cast<std::size_t>(c))) == linear)
      columns.push_back(c);
  return all(Eigen::all, columns);
}

// As recorded, else estimated.
void measure_acceleration_jump(const Recording& recording, const RecordedJoin& join, int line_ticks,
                               JoinMetrics& metrics) {
  const auto found = [&](double recorded, bool linear) {
    if (!std::isnan(recorded)) return Estimate{recorded, 0.0};
    return estimated_jump(recording, accelerations(recording, linear), join.time, line_ticks);
  };
  const Estimate angular = found(join.acceleration_jump, false);
  const Estimate linear = found(join.linear_jump, true);
  metrics.acceleration_jump_rad_s2 = angular.size;
  metrics.acceleration_jump_error_rad_s2 = angular.error;
  metrics.acceleration_jump_m_s2 = linear.size;
  metrics.acceleration_jump_error_m_s2 = linear.error;
}

std::vector<JoinMetrics> measure_joins(const Recording& recording, const MetricSettings& settings) {
  const Eigen::MatrixXd error = tracking_error(recording);
  std::vector<JoinMetrics> joins;
  for (const RecordedJoin& join : recording.joins) {
    JoinMetrics& metrics = joins.emplace_back();
    const auto after = [&](const Eigen::MatrixXd& signal) {
      return peak_after(recording, join, settings.after_join, signal);
    };
    metrics.time = join.time;
    measure_torque_jump(recording, settings.line_ticks, metrics);
    measure_acceleration_jump(recording, join, settings.line_ticks, metrics);
    metrics.tracking_max_rad = after(error);
    metrics.tool_tracking_max_m = after(recording.tool_error_m);
    metrics.tool_tracking_max_rad = after(recording.tool_error_rad);
  }
  return joins;
}

double share_saturated(const Recording& recording) {
  if (recording.torque.size() == 0 || !limits_known(recording)) return unknown;
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

void require_half(const Recording& recording, const Recording& half) {
  if (half.ticks() < 2) throw Error(half.source, "fewer than 2 ticks");
  if (!(std::abs(recording.dt() / half.dt() - 2.0) <= same_tick))
    throw Error(half.source, "a tick of " + shown(half.dt()) + " s, must be " +
                                 shown(0.5 * recording.dt()) + " s, half of the other's");
  bool same = half.joins.size() == recording.joins.size();
  for (std::size_t i = 0; same && i < half.joins.size(); ++i)
    same = std::abs(half.joins[i].time - recording.joins[i].time) <= (1.0 + same_tick) * half.dt();
  if (!same) throw Error(half.source, "has other joins than the run at the whole tick");
}

void measure_orders(const Recording& half, const MetricSettings& settings, RunMetrics& metrics) {
  const double rounding = 1e-13 * peak(half.torque);
  const std::vector<JoinMetrics> finer = measure_joins(half, settings);
  for (std::size_t i = 0; i < finer.size(); ++i) {
    JoinMetrics& join = metrics.joins[i];
    if (join.torque_jump_nm > rounding)
      join.torque_jump_order = jump_order(join.torque_jump_nm, finer[i].torque_jump_nm);
    if (join.torque_jump_nm == metrics.torque_jump_nm)
      metrics.torque_jump_order = join.torque_jump_order;
  }
}

void require_comparable(const Recording& recording, const Recording& other) {
  const auto refuse = [&](const std::string& what) {
    throw Error(other.source, what + " as " + recording.source);
  };
  if (other.ticks() != recording.ticks())
    refuse(std::to_string(other.ticks()) + " ticks, must be " + std::to_string(recording.ticks()));
  for (Eigen::Index k = 0; k < recording.ticks(); ++k)
    if (!(std::abs(other.time(k) - recording.time(k)) <= same_tick * recording.dt()))
      refuse("tick " + std::to_string(k + 1) + " at " + shown(other.time(k)) + " s, must be at " +
             shown(recording.time(k)) + " s");
  if (other.joints != recording.joints || other.coordinates != recording.coordinates ||
      other.ref.cols() != recording.ref.cols() ||
      other.tool_ref.cols() != recording.tool_ref.cols())
    refuse("other joints or coordinates, must be the same");
}

// Until a deviation stays below a share of its peak in the ticks from `first` to `end`.
double fading_time(const Eigen::VectorXd& time, const Eigen::VectorXd& deviation,
                   Eigen::Index first, Eigen::Index end, double from, double share) {
  const double peak = deviation.segment(first, end - first).maxCoeff();
  if (peak <= no_deviation) return 0.0;
  Eigen::Index last = end - 1;
  while (last > first && deviation(last) <= share * peak) --last;
  return last == end - 1 ? unknown : time(last + 1) - from;
}

void measure_deviation_of_joints(const Recording& recording, const Eigen::VectorXd& deviation,
                                 const MetricSettings& settings, RunMetrics& metrics) {
  const Eigen::Index N = recording.ticks();
  Eigen::Index at = 0;
  metrics.deviation_peak_rad = deviation.maxCoeff(&at);
  double joined = recording.time(0);
  for (std::size_t i = 0; i < metrics.joins.size(); ++i) {
    JoinMetrics& join = metrics.joins[i];
    const auto [first, end] = until_next_join(recording, recording.joins[i]);
    if (first >= end) continue;
    join.deviation_peak_rad = deviation.segment(first, end - first).maxCoeff();
    join.deviation_faded_s =
        fading_time(recording.time, deviation, first, end, join.time, settings.faded_share);
    if (first <= at) joined = std::max(joined, join.time);
  }
  metrics.deviation_faded_s =
      fading_time(recording.time, deviation, 0, N, joined, settings.faded_share);
}

void measure_deviation(const Recording& recording, const Recording& dmp2,
                       const MetricSettings& settings, RunMetrics& metrics) {
  require_comparable(recording, dmp2);
  if (recording.ref.size() > 0)
    measure_deviation_of_joints(
        recording, (recording.ref - dmp2.ref).cwiseAbs().rowwise().maxCoeff(), settings, metrics);
  if (recording.tool_ref.cols() >= 3)
    metrics.deviation_peak_m =
        (recording.tool_ref - dmp2.tool_ref).leftCols<3>().rowwise().norm().maxCoeff();
}

void require_good(const MetricSettings& settings) {
  if (settings.line_ticks < 2)
    throw Error("metrics", "line_ticks " + std::to_string(settings.line_ticks) + ", must be >= 2");
  if (!(settings.after_join >= 0.0))
    throw Error("metrics", "after_join " + shown(settings.after_join) + " s, must be >= 0");
  if (!(settings.faded_share > 0.0 && settings.faded_share < 1.0))
    throw Error("metrics", "faded_share " + shown(settings.faded_share) + ", must be in 0 to 1");
}

}  // namespace

Eigen::VectorXd jump(const Eigen::VectorXd& time, const Eigen::MatrixXd& signal, double at,
                     int line_ticks) {
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(signal.cols(), unknown);
  if (time.size() < 2 || signal.rows() != time.size() || line_ticks < 2 || std::isnan(at))
    return none;
  const Eigen::Index tick = tick_at(time, at);
  const Eigen::Index before = tick - gap_ticks - line_ticks + 1;
  const Eigen::Index after = tick + gap_ticks;
  if (before < 0 || after + line_ticks > time.size()) return none;
  return line_at(time, signal, after, line_ticks, at) -
         line_at(time, signal, before, line_ticks, at);
}

double jump_order(double at_dt, double at_half_dt) {
  return std::log2(at_dt / at_half_dt);
}

RunMetrics measure(const Recording& recording, const Companions& companions,
                   const MetricSettings& settings) {
  require_good(settings);
  recording.validate();
  if (recording.ticks() < 2) throw Error(recording.source, "fewer than 2 ticks");
  RunMetrics metrics;
  metrics.joins = measure_joins(recording, settings);
  metrics.torque_jump_nm = worst(metrics.joins, &JoinMetrics::torque_jump_nm);
  metrics.torque_jump_percent = worst(metrics.joins, &JoinMetrics::torque_jump_percent);
  metrics.acceleration_jump_rad_s2 = worst(metrics.joins, &JoinMetrics::acceleration_jump_rad_s2);
  metrics.acceleration_jump_m_s2 = worst(metrics.joins, &JoinMetrics::acceleration_jump_m_s2);
  metrics.acceleration_jump_error_rad_s2 =
      worst(metrics.joins, &JoinMetrics::acceleration_jump_error_rad_s2);
  metrics.acceleration_jump_error_m_s2 =
      worst(metrics.joins, &JoinMetrics::acceleration_jump_error_m_s2);
  metrics.tracking_after_join_max_rad = worst(metrics.joins, &JoinMetrics::tracking_max_rad);
  metrics.tool_tracking_after_join_max_m = worst(metrics.joins, &JoinMetrics::tool_tracking_max_m);
  metrics.tool_tracking_after_join_max_rad =
      worst(metrics.joins, &JoinMetrics::tool_tracking_max_rad);
  const Eigen::MatrixXd torque_rate = rate(recording.torque, recording.dt());
  const Eigen::MatrixXd jerk = rate(recording.ref_acc, recording.dt());
  const Eigen::MatrixXd error = tracking_error(recording);
  metrics.torque_rate_peak_nm_s = peak(torque_rate);
  metrics.torque_rate_rms_nm_s = worst_rms(torque_rate);
  metrics.jerk_peak_rad_s3 = peak(jerk);
  metrics.jerk_rms_rad_s3 = worst_rms(jerk);
  metrics.tracking_max_rad = peak(error);
  metrics.tracking_rms_rad = worst_rms(error);
  metrics.saturated_share = share_saturated(recording);
  measure_tool(recording, metrics);
  if (companions.half) {
    require_half(recording, *companions.half);
    measure_orders(*companions.half, settings, metrics);
  }
  if (companions.dmp2) measure_deviation(recording, *companions.dmp2, settings, metrics);
  return metrics;
}

}  // namespace seam
