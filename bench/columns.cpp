#include "bench/columns.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace seam {

const std::vector<Column>& columns() {
  static const std::vector<Column> list{
      {"torque_jump_nm", "torque jump", "N·m", "{:.3g}",
       [](const Run& r) { return r.metrics.torque_jump_nm; }},
      {"torque_jump_percent", "of limit", "%", "{:.2g}",
       [](const Run& r) { return r.metrics.torque_jump_percent; }},
      {"torque_jump_order", "order", "in dt", "{:.2f}",
       [](const Run& r) { return r.torque_jump_order; }},
      {"acceleration_jump_rad_s2", "accel. jump", "rad/s²", "{:.2g}",
       [](const Run& r) { return r.metrics.acceleration_jump_rad_s2; }},
      {"torque_rate_peak_nm_s", "peak torque rate", "N·m/s", "{:.0f}",
       [](const Run& r) { return r.metrics.torque_rate_peak_nm_s; }},
      {"torque_rate_rms_nm_s", "RMS", "N·m/s", "{:.0f}",
       [](const Run& r) { return r.metrics.torque_rate_rms_nm_s; }},
      {"jerk_peak_rad_s3", "peak jerk", "rad/s³", "{:.0f}",
       [](const Run& r) { return r.metrics.jerk_peak_rad_s3; }},
      {"jerk_rms_rad_s3", "RMS", "rad/s³", "{:.0f}",
       [](const Run& r) { return r.metrics.jerk_rms_rad_s3; }},
      {"tracking_rms_rad", "tracking RMS", "rad", "{:.1e}",
       [](const Run& r) { return r.metrics.tracking_rms_rad; }},
      {"tracking_max_rad", "max", "rad", "{:.1e}",
       [](const Run& r) { return r.metrics.tracking_max_rad; }},
      {"deviation_peak_rad", "deviation", "rad", "{:.3f}",
       [](const Run& r) { return r.deviation_peak_rad; }},
  };
  return list;
}

namespace {

// Characters that a UTF-8 text takes on the screen.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

std::string cell(const Column& column, const Run& run) {
  if (!std::isfinite(column.of(run))) return "n/a";
  const std::string text = fmt::format(fmt::runtime(column.format), column.of(run));
  const bool minus_zero = text[0] == '-' && text.find_first_of("123456789") == std::string::npos;
  return minus_zero ? text.substr(1) : text;
}

std::vector<std::vector<std::string>> cells(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows(1, {"method"});
  for (const Column& column : columns())
    rows[0].push_back(fmt::format("{} [{}]", column.heading, column.unit));
  for (const Run& run : comparison.runs) {
    std::vector<std::string> row{std::string(to_string(run.method))};
    for (const Column& column : columns()) row.push_back(cell(column, run));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::string table(const Comparison& comparison) {
  const auto rows = cells(comparison);
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string padding(widths[c] - width(rows[r][c]), ' ');
      text += c == 0 ? "| " + rows[r][c] + padding + " |" : " " + padding + rows[r][c] + " |";
    }
    text += '\n';
    if (r > 0) continue;
    for (std::size_t c = 0; c < widths.size(); ++c)
      text += c == 0 ? "|" + std::string(widths[c] + 2, '-') + "|"
                     : std::string(widths[c] + 1, '-') + ":|";
    text += '\n';
  }
  return text;
}

}  // namespace seam
