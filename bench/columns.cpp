#include "bench/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "bench/markdown.hpp"

namespace seam {

namespace {

using Metric = double RunMetrics::*;

// Outcomes that have a column of their own in the overview, or are told only where they are not 0.
constexpr const char* limited = "limited_share";
constexpr const char* stopped = "stopped_share";
// Those that explain others: they are in their scene's own table.
constexpr std::array<const char*, 3> explaining{"wave_peak_m", "ringing_nm", "resonance_hz"};

// How the units that end an outcome's name are written: in tables, and for people with their factor.
struct Unit {
  std::string ending, heading, shown;
  double factor;
};
const std::array<Unit, 6> units{{{"_share", "", "{:.3g} %", 100.0},
                                 {"_m_s", " [m/s]", "{:.1f} mm/s", 1e3},
                                 {"_m", " [m]", "{:.1f} mm", 1e3},
                                 {"_s", " [s]", "{:.1f} ms", 1e3},
                                 {"_nm", " [N·m]", "{:.3g} N·m", 1.0},
                                 {"_hz", " [Hz]", "{:.3g} Hz", 1.0}}};

// "miss_m" as "miss" and metres; of an unknown unit as it is.
std::pair<std::string, Unit> split(std::string name) {
  Unit unit{"", "", "{:.3g}", 1.0};
  for (const Unit& known : units) {
    const std::size_t length = known.ending.size();
    if (name.size() <= length || name.substr(name.size() - length) != known.ending) continue;
    name.resize(name.size() - length);
    unit = known;
    break;
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return {name, unit};
}

Column metric(const char* name, const char* heading, const char* format, Metric of) {
  return {name, heading, format, [of](const Run& run) { return run.metrics.*of; }};
}

double outcome(const Run& run, const std::string& name) {
  for (const Outcome& outcome : run.recording.outcomes)
    if (outcome.name == name) return outcome.value;
  return std::numeric_limits<double>::quiet_NaN();
}

// "spilled_share" as "spilled", "wave_peak_m" as "wave peak [m]".
std::string heading_of(const std::string& name) {
  if (name == limited) return "share of time at a limit of the drives";
  const auto [words, unit] = split(name);
  return words + unit.heading;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// What is said of joints in rad and N·m, in the units of those that there are.
std::string of_joints(const Recording& recording, const std::string& heading) {
  std::size_t sliding = 0;
  for (std::size_t i = 0; i < recording.joints.size(); ++i) sliding += recording.slides_at(i);
  if (sliding == 0 || heading.rfind("tool", 0) == 0) return heading;
  const bool all = sliding == recording.joints.size();
  return replaced(replaced(heading, "[rad", all ? "[m" : "[rad or m"), "[N·m",
                  all ? "[N" : "[N·m or N");
}

// A figure of a run's or a join's metrics.
template <typename Metrics>
struct Figure {
  const char* name;
  std::string heading;
  double Metrics::*of;
};

// Which accelerations jump, in what they are measured, and whether they were recorded.
struct Jumps {
  explicit Jumps(const Recording& recording) {
    const bool tool = recording.in_task_space();
    linear = tool;
    angular = tool && recording.coordinates.size() > 3;
    for (std::size_t i = 0; i < recording.joints.size() && !tool; ++i)
      (recording.slides_at(i) ? linear : angular) = true;
    for (const RecordedJoin& join : recording.joins)
      estimated |= std::isnan(join.acceleration_jump) && std::isnan(join.linear_jump);
  }

  // None if none is measured so; with their error if they are estimated.
  template <typename Metrics>
  std::vector<Figure<Metrics>> in_metres() const {
    return figures<Metrics>(
        linear, " [m/s²]", {"acceleration_jump_m_s2", "", &Metrics::acceleration_jump_m_s2},
        {"acceleration_jump_error_m_s2", "", &Metrics::acceleration_jump_error_m_s2});
  }
  template <typename Metrics>
  std::vector<Figure<Metrics>> in_radians() const {
    return figures<Metrics>(
        angular, " [rad/s²]", {"acceleration_jump_rad_s2", "", &Metrics::acceleration_jump_rad_s2},
        {"acceleration_jump_error_rad_s2", "", &Metrics::acceleration_jump_error_rad_s2});
  }

 private:
  template <typename Metrics>
  std::vector<Figure<Metrics>> figures(bool there, const std::string& unit, Figure<Metrics> size,
                                       Figure<Metrics> error) const {
    if (!there) return {};
    size.heading = (estimated ? "acceleration jump, estimated" : "acceleration jump") + unit;
    error.heading = "estimate off by about" + unit;
    return estimated ? std::vector{size, error} : std::vector{size};
  }

  bool linear = false, angular = false, estimated = false;
};

}  // namespace

std::vector<Column> columns(const Recording& recording) {
  const bool tool = recording.in_task_space();
  const Jumps jumps(recording);
  using M = RunMetrics;
  std::vector<Column> list;
  const auto add = [&](bool there, Column column) {
    column.heading = of_joints(recording, column.heading);
    if (there) list.push_back(std::move(column));
  };
  const auto add_jumps = [&](const std::vector<Figure<M>>& figures) {
    for (const Figure<M>& figure : figures)
      list.push_back(metric(figure.name, figure.heading.c_str(), "{:.2g}", figure.of));
  };
  add(true, metric("torque_jump_nm", "torque jump [N·m]", "{:.3g}", &M::torque_jump_nm));
  add(true, metric("torque_jump_percent", "torque jump, of the limit [%]", "{:.2g}",
                   &M::torque_jump_percent));
  add(true,
      metric("torque_jump_order", "torque jump, order in dt", "{:.2f}", &M::torque_jump_order));
  add_jumps(jumps.in_metres<M>());
  add_jumps(jumps.in_radians<M>());
  add(true, metric("torque_rate_peak_nm_s", "torque rate, peak [N·m/s]", "{:.0f}",
                   &M::torque_rate_peak_nm_s));
  add(true, metric("torque_rate_rms_nm_s", "torque rate, RMS [N·m/s]", "{:.0f}",
                   &M::torque_rate_rms_nm_s));
  add(true, metric("saturated_share", "share of time at the effort limit", "{:.2g}",
                   &M::saturated_share));
  add(true, metric("jerk_peak_rad_s3", "jerk, peak [rad/s³]", "{:.0f}", &M::jerk_peak_rad_s3));
  add(true, metric("jerk_rms_rad_s3", "jerk, RMS [rad/s³]", "{:.0f}", &M::jerk_rms_rad_s3));
  add(true, metric("tracking_rms_rad", "tracking, RMS [rad]", "{:.1e}", &M::tracking_rms_rad));
  add(true, metric("tracking_max_rad", "tracking, max [rad]", "{:.1e}", &M::tracking_max_rad));
  add(true, metric("tracking_after_join_max_rad", "tracking, max after a join [rad]", "{:.1e}",
                   &M::tracking_after_join_max_rad));
  add(tool,
      metric("tool_tracking_rms_m", "tool tracking, RMS [m]", "{:.1e}", &M::tool_tracking_rms_m));
  add(tool,
      metric("tool_tracking_max_m", "tool tracking, max [m]", "{:.1e}", &M::tool_tracking_max_m));
  add(tool, metric("tool_tracking_rms_rad", "tool tracking, RMS [rad]", "{:.1e}",
                   &M::tool_tracking_rms_rad));
  add(tool, metric("tool_tracking_max_rad", "tool tracking, max [rad]", "{:.1e}",
                   &M::tool_tracking_max_rad));
  add(tool, metric("tool_tracking_after_join_max_m", "tool tracking, max after a join [m]",
                   "{:.1e}", &M::tool_tracking_after_join_max_m));
  add(tool, metric("tool_tracking_after_join_max_rad", "tool tracking, max after a join [rad]",
                   "{:.1e}", &M::tool_tracking_after_join_max_rad));
  add(tool, metric("deviation_peak_m", "deviation, peak of the tool [m]", "{:.3f}",
                   &M::deviation_peak_m));
  add(true,
      metric("deviation_peak_rad", "deviation, peak [rad]", "{:.3f}", &M::deviation_peak_rad));
  add(true,
      metric("deviation_faded_s", "deviation, faded after [s]", "{:.2f}", &M::deviation_faded_s));
  for (const Outcome& scene : recording.outcomes)
    list.push_back({scene.name, heading_of(scene.name), "{:.3g}",
                    [name = scene.name](const Run& run) { return outcome(run, name); }});
  return list;
}

std::map<std::string, double> figures(const Run& run) {
  std::map<std::string, double> figures;
  for (const Column& column : columns(run.recording)) figures[column.name] = column.of(run);
  return figures;
}

std::vector<JoinColumn> join_columns(const Recording& recording) {
  using J = JoinMetrics;
  const Jumps jumps(recording);
  std::vector<JoinColumn> list{
      {"torque_jump_nm", "torque jump [N·m]", "{:.3g}", &J::torque_jump_nm},
      {"torque_jump_percent", "torque jump, of the limit [%]", "{:.2g}", &J::torque_jump_percent},
      {"torque_jump_order", "torque jump, order in dt", "{:.2f}", &J::torque_jump_order}};
  for (const auto& figures : {jumps.in_radians<J>(), jumps.in_metres<J>()})
    for (const Figure<J>& figure : figures)
      list.push_back({figure.name, figure.heading, "{:.2g}", figure.of});
  list.push_back({"tracking_max_rad", "tracking [rad]", "{:.1e}", &J::tracking_max_rad});
  if (recording.in_task_space()) {
    list.push_back({"tool_tracking_max_m", "tool tracking [m]", "{:.1e}", &J::tool_tracking_max_m});
    list.push_back(
        {"tool_tracking_max_rad", "tool tracking [rad]", "{:.1e}", &J::tool_tracking_max_rad});
  }
  list.push_back({"deviation_peak_rad", "deviation [rad]", "{:.3f}", &J::deviation_peak_rad});
  list.push_back({"deviation_faded_s", "faded after [s]", "{:.2f}", &J::deviation_faded_s});
  for (JoinColumn& column : list) column.heading = of_joints(recording, column.heading);
  return list;
}

namespace {

// A metric a row, a method a column.
Rows cells(const Comparison& comparison) {
  Rows rows(1, {"metric"});
  for (const Run& run : comparison.runs) rows[0].emplace_back(to_string(run.method));
  for (const Column& column : columns(comparison.runs.front().recording)) {
    std::vector<std::string>& row = rows.emplace_back(1, column.heading);
    for (const Run& run : comparison.runs) row.push_back(shown(column.of(run), column.format));
  }
  return rows;
}

ShownOutcome shown_outcome(const Outcome& outcome) {
  const auto [words, unit] = split(outcome.name);
  if (std::isnan(outcome.value)) return {words, "n/a"};
  return {words, fmt::format(fmt::runtime(unit.shown), unit.factor * outcome.value)};
}

bool has_a_place_elsewhere(const Outcome& outcome) {
  return outcome.name == limited ||
         std::find(explaining.begin(), explaining.end(), outcome.name) != explaining.end();
}

// The same scene and method on each arm, the ideal one first.
using OnArms = std::vector<const Run*>;

// `a / b`, or one of them if they are alike.
std::string of_both(const std::vector<std::string>& values) {
  return values.front() == values.back() ? values.front() : values.front() + " / " + values.back();
}

std::string of_both(const OnArms& runs, Metric of, const char* format) {
  std::vector<std::string> values;
  for (const Run* run : runs) values.push_back(shown(run->metrics.*of, format));
  return of_both(values);
}

// What a scene adds, in words.
std::string came_of(const OnArms& runs) {
  std::string text;
  for (const Outcome& of_first : runs.front()->recording.outcomes) {
    if (has_a_place_elsewhere(of_first)) continue;
    double most = 0.0;
    std::vector<std::string> values;
    for (const Run* run : runs) {
      const Outcome of_run{of_first.name, outcome(*run, of_first.name)};
      most = std::max(most, of_run.value);
      values.push_back(shown_outcome(of_run).value);
    }
    if (of_first.name == stopped && most == 0.0) continue;
    text += (text.empty() ? "" : ", ") + shown_outcome(of_first).name + " " + of_both(values);
  }
  return text;
}

// In thousandths, with two digits or as a whole number.
std::string thousandths(double value, const std::string& unit) {
  return shown(1e3 * value, value < 0.00995 ? "{:#.2g}" : "{:.0f}") + " m" + unit;
}

// By how much a tool or, where there is none, a joint is missed.
std::string missed(const Recording& recording, double joints, double tool_m, double tool_rad) {
  if (recording.in_task_space())
    return thousandths(tool_m, "m") +
           (std::isnan(tool_rad) ? "" : ", " + thousandths(tool_rad, "rad"));
  const std::string unit = of_joints(recording, "[rad]");
  return thousandths(joints, replaced(unit.substr(1, unit.size() - 2), "or m", "or mm"));
}

std::vector<std::string> overview_row(const Scene& scene, const OnArms& runs) {
  using M = RunMetrics;
  const Run& last = *runs.back();
  const RunMetrics& metrics = last.metrics;
  return {scene.name,
          std::string(to_string(last.method)),
          came_of(runs),
          of_both(runs, &M::torque_jump_nm, "{:.3g}"),
          of_both(runs, &M::torque_jump_order, "{:.1f}"),
          of_both(runs, &M::torque_rate_peak_nm_s, "{:.0f}"),
          missed(last.recording, metrics.tracking_after_join_max_rad,
                 metrics.tool_tracking_after_join_max_m, metrics.tool_tracking_after_join_max_rad),
          missed(last.recording, metrics.tracking_max_rad, metrics.tool_tracking_max_m,
                 metrics.tool_tracking_max_rad),
          shown(100.0 * outcome(last, limited), "{:.2g}")};
}

// What the overview's columns are of, where there are two arms.
std::string legend(const std::set<std::string>& others) {
  std::string arm;
  for (const std::string& other : others) arm += (arm.empty() ? "" : " or ") + other;
  return fmt::format(
      "\n`a / b`: on the ideal arm / on the {0} arm; one figure where both agree. Tracking "
      "errors, in the 0.2 s after a join and over all, and the time at a limit "
      "of the drives: on the {0} arm.\n",
      arm);
}

}  // namespace

std::vector<ShownOutcome> shown_outcomes(const Recording& recording) {
  std::vector<ShownOutcome> all;
  for (const Outcome& outcome : recording.outcomes)
    if (outcome.name != limited && !(outcome.name == stopped && outcome.value == 0.0))
      all.push_back(shown_outcome(outcome));
  return all;
}

std::string table(const Comparison& comparison) {
  return markdown(cells(comparison), 1);
}

std::string overview(const std::vector<Comparison>& comparisons) {
  Rows rows{{"scene", "method", "what came of it", "torque jump [N·m]", "order",
             "peak torque rate [N·m/s]", "error after a join", "largest error", "at a limit [%]"}};
  std::set<std::string> others;
  for (auto on_one = comparisons.begin(); on_one != comparisons.end();) {
    const auto end = std::find_if(on_one, comparisons.end(), [&](const Comparison& other) {
      return other.scene.name != on_one->scene.name;
    });
    for (std::size_t i = 0; i < on_one->runs.size(); ++i) {
      OnArms runs;
      for (auto on_arm = on_one; on_arm != end; ++on_arm) runs.push_back(&on_arm->runs[i]);
      rows.push_back(overview_row(on_one->scene, runs));
    }
    if (end - on_one > 1) others.insert((end - 1)->scene.arm);
    on_one = end;
  }
  return markdown(rows, 3) + (others.empty() ? "" : legend(others));
}

}  // namespace seam
