#include "bench/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace seam {

namespace {

using Metric = double RunMetrics::*;

Column metric(const char* name, const char* heading, const char* format, Metric of) {
  return {name, heading, format, [of](const Run& run) { return run.metrics.*of; }};
}

double outcome(const Run& run, const std::string& name) {
  for (const Outcome& outcome : run.recording.outcomes)
    if (outcome.name == name) return outcome.value;
  return std::numeric_limits<double>::quiet_NaN();
}

// "spilled_share" as "spilled", "wave_peak_m" as "wave peak [m]".
std::string heading_of(std::string name) {
  std::string unit;
  for (const char* ending : {"_share", "_m"}) {
    const std::size_t length = std::string(ending).size();
    if (name.size() <= length || name.substr(name.size() - length) != ending) continue;
    name.resize(name.size() - length);
    if (ending[1] == 'm') unit = " [m]";
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + unit;
}

}  // namespace

std::vector<Column> columns(const Comparison& comparison) {
  const Recording& recording = comparison.runs.front().recording;
  const bool tool = recording.in_task_space();
  using M = RunMetrics;
  std::vector<Column> list{
      metric("torque_jump_nm", "torque jump [N·m]", "{:.3g}", &M::torque_jump_nm),
      metric("torque_jump_percent", "of limit [%]", "{:.2g}", &M::torque_jump_percent),
      {"torque_jump_order", "order [in dt]", "{:.2f}",
       [](const Run& r) { return r.torque_jump_order; }},
  };
  if (tool)
    list.push_back(metric("acceleration_jump_m_s2", "accel. jump [m/s²]", "{:.2g}",
                          &M::acceleration_jump_m_s2));
  if (!tool || comparison.scene.sequence.coordinates().size() > 3)
    list.push_back(metric("acceleration_jump_rad_s2", "accel. jump [rad/s²]", "{:.2g}",
                          &M::acceleration_jump_rad_s2));
  for (const Column& column :
       {metric("torque_rate_peak_nm_s", "peak torque rate [N·m/s]", "{:.0f}",
               &M::torque_rate_peak_nm_s),
        metric("torque_rate_rms_nm_s", "RMS [N·m/s]", "{:.0f}", &M::torque_rate_rms_nm_s),
        metric("jerk_peak_rad_s3", "peak jerk [rad/s³]", "{:.0f}", &M::jerk_peak_rad_s3),
        metric("jerk_rms_rad_s3", "RMS [rad/s³]", "{:.0f}", &M::jerk_rms_rad_s3),
        metric("tracking_rms_rad", "tracking RMS [rad]", "{:.1e}", &M::tracking_rms_rad),
        metric("tracking_max_rad", "max [rad]", "{:.1e}", &M::tracking_max_rad)})
    list.push_back(column);
  if (tool) {
    list.push_back(
        metric("tool_tracking_max_m", "tool, max [m]", "{:.1e}", &M::tool_tracking_max_m));
    list.push_back(
        metric("tool_tracking_max_rad", "max [rad]", "{:.1e}", &M::tool_tracking_max_rad));
    list.push_back({"deviation_peak_m", "deviation [m]", "{:.3f}",
                    [](const Run& r) { return r.deviation_peak_m; }});
  }
  list.push_back({"deviation_peak_rad", tool ? "[rad]" : "deviation [rad]", "{:.3f}",
                  [](const Run& r) { return r.deviation_peak_rad; }});
  for (const Outcome& scene : recording.outcomes)
    list.push_back({scene.name, heading_of(scene.name), "{:.3g}",
                    [name = scene.name](const Run& run) { return outcome(run, name); }});
  return list;
}

namespace {

// Characters that a UTF-8 text takes on the screen.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

std::string shown(double value, const std::string& format) {
  if (!std::isfinite(value)) return "n/a";
  const std::string text = fmt::format(fmt::runtime(format), value);
  const bool minus_zero = text[0] == '-' && text.find_first_of("123456789") == std::string::npos;
  return minus_zero ? text.substr(1) : text;
}

using Rows = std::vector<std::vector<std::string>>;

Rows cells(const Comparison& comparison) {
  Rows rows(1, {"method"});
  const std::vector<Column> list = columns(comparison);
  for (const Column& column : list) rows[0].push_back(column.heading);
  for (const Run& run : comparison.runs) {
    std::vector<std::string> row{std::string(to_string(run.method))};
    for (const Column& column : list) row.push_back(shown(column.of(run), column.format));
    rows.push_back(std::move(row));
  }
  return rows;
}

// Aligned for reading on a terminal; the first `texts` columns to the left.
std::string markdown(const Rows& rows, std::size_t texts) {
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += "|";
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string padding(widths[c] - width(rows[r][c]), ' ');
      text += c < texts ? " " + rows[r][c] + padding + " |" : " " + padding + rows[r][c] + " |";
    }
    text += '\n';
    if (r > 0) continue;
    text += "|";
    for (std::size_t c = 0; c < widths.size(); ++c)
      text += std::string(widths[c] + (c < texts ? 2 : 1), '-') + (c < texts ? "|" : ":|");
    text += '\n';
  }
  return text;
}

// What a scene adds, in words.
std::string came_of(const Run& run) {
  std::string text;
  for (const Outcome& outcome : run.recording.outcomes) {
    if (outcome.name == "stopped_share" && outcome.value == 0.0) continue;
    const bool share = outcome.name.find("_share") != std::string::npos;
    text += (text.empty() ? "" : ", ") + outcome.name.substr(0, outcome.name.rfind('_')) + " " +
            (share ? fmt::format("{:.3g} %", 100.0 * outcome.value)
                   : fmt::format("{:.1f} mm", 1e3 * outcome.value));
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

std::string table(const Comparison& comparison) {
  return markdown(cells(comparison), 1);
}

std::string overview(const std::vector<Comparison>& comparisons) {
  Rows rows{{"scene", "method", "what came of it", "torque jump [N·m]", "of dmp2's [%]", "order",
             "peak torque rate [N·m/s]", "peak jerk [rad/s³]", "deviation [rad]"}};
  for (const Comparison& comparison : comparisons) {
    const auto dmp2 = std::find_if(comparison.runs.begin(), comparison.runs.end(),
                                   [](const Run& run) { return run.method == Join::dmp2; });
    for (const Run& run : comparison.runs) {
      const double share = dmp2 == comparison.runs.end()
                               ? std::numeric_limits<double>::quiet_NaN()
                               : 100.0 * run.metrics.torque_jump_nm / dmp2->metrics.torque_jump_nm;
      rows.push_back(
          {comparison.scene.name, std::string(to_string(run.method)), came_of(run),
           shown(run.metrics.torque_jump_nm, "{:.3g}"),
           shown(share, share < 10.0 ? "{:.2g}" : "{:.0f}"), shown(run.torque_jump_order, "{:.1f}"),
           shown(run.metrics.torque_rate_peak_nm_s, "{:.0f}"),
           shown(run.metrics.jerk_peak_rad_s3, "{:.0f}"), shown(run.deviation_peak_rad, "{:.3f}")});
    }
  }
  return markdown(rows, 3);
}

}  // namespace seam
