#include "bench/metrics_command.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/columns.hpp"
#include "bench/markdown.hpp"
#include "bench/run_json.hpp"
#include "scenes/own_folders.hpp"
#include <seam/error.hpp>
#include <seam/robot_model.hpp>

namespace seam {

namespace {

struct Options {
  std::string recording, half, compared, urdf;
  std::vector<double> joins;  // [s]
  MetricSettings settings;
  bool json = false;
};

Recording read(const std::string& path, const std::vector<double>& joins) {
  Recording recording = Recording::read(path);
  if (joins.empty()) return recording;
  recording.joins.clear();
  const double end = recording.time(recording.ticks() - 1);
  for (const double time : joins) {
    if (!(time >= recording.time(0) && time <= end))
      throw Error("--join", fmt::format("{} s, must be within {}, {} to {} s", time, path,
                                        recording.time(0), end));
    recording.joins.push_back({time});
  }
  return recording;
}

void set_limits(const std::string& urdf, Recording& recording) {
  const RobotModel robot = RobotModel::read(urdf);
  for (std::size_t i = 0; i < recording.joints.size(); ++i) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(robot.joint(recording.joints[i]))];
    recording.effort(static_cast<Eigen::Index>(i)) = joint.effort;
    recording.slides[i] = joint.type == Joint::Type::prismatic;
  }
}

bool measured(const RunMetrics& metrics, const JoinColumn& column) {
  return std::any_of(metrics.joins.begin(), metrics.joins.end(),
                     [&](const JoinMetrics& join) { return !std::isnan(join.*column.of); });
}

std::string joins_table(const Run& run) {
  std::vector<JoinColumn> list;
  for (const JoinColumn& column : join_columns(run.recording))
    if (measured(run.metrics, column)) list.push_back(column);
  Rows rows(1, {"join [s]", "joint"});
  for (const JoinColumn& column : list) rows[0].push_back(column.heading);
  for (const JoinMetrics& join : run.metrics.joins) {
    auto& row = rows.emplace_back();
    row.push_back(fmt::format("{:.6g}", join.time));
    row.push_back(join.joint < 0 ? "n/a"
                                 : run.recording.joints[static_cast<std::size_t>(join.joint)]);
    for (const JoinColumn& column : list) row.push_back(shown(join.*column.of, column.format));
  }
  return markdown(rows, 2);
}

// What a metric needs and the recording lacks; the first that fits, of the names that begin so.
std::string lacking(const std::string& metric, const Recording& recording, const Options& options) {
  const struct {
    const char* metrics;
    bool is_lacking;
    const char* what;
  } needs[] = {
      {"torque", recording.torque.size() == 0, "columns torque.<joint>"},
      {"saturated", recording.torque.size() == 0, "columns torque.<joint>"},
      {"saturated", true, "the joints' effort limits (--urdf)"},
      {"acceleration", recording.ref_acc.size() + recording.tool_acc.size() == 0,
       "columns ref_acc.<joint>"},
      {"jerk", true, "columns ref_acc.<joint>"},
      {"tracking", recording.ref.size() == 0 || recording.q.size() == 0,
       "columns ref.<joint> and q.<joint>"},
      {"tool_tracking", recording.tool_error_m.size() == 0,
       "columns tool_error_m and tool_error_rad"},
      {"deviation", options.compared.empty(), "another run (--compare)"},
      {"deviation_faded", true, "a longer recording: it has not faded at the end"},
      {"deviation", true, "columns ref.<joint>"},
      {"", recording.joins.empty(), "a join (--join, or a column switch that changes)"},
      {"torque_jump_percent", options.urdf.empty(), "the joints' effort limits (--urdf)"},
      {"torque_jump_order", options.half.empty(), "the same run at half the tick (--half)"},
      {"", true, "more ticks to either side of every join"},
  };
  for (const auto& need : needs)
    if (need.is_lacking && metric.rfind(need.metrics, 0) == 0) return need.what;
  return {};
}

std::string run_table(const Run& run, const Options& options) {
  Rows rows{{"metric", "value"}};
  std::vector<std::pair<std::string, std::string>> unmeasured;  // what is lacking, metrics
  for (const Column& column : columns(run.recording)) {
    const double value = column.of(run);
    if (!std::isnan(value)) {
      rows.push_back({column.heading, shown(value, column.format)});
      continue;
    }
    const std::string lack = lacking(column.name, run.recording, options);
    const auto same = std::find_if(unmeasured.begin(), unmeasured.end(),
                                   [&](const auto& other) { return other.first == lack; });
    if (same == unmeasured.end())
      unmeasured.emplace_back(lack, column.name);
    else
      same->second += ", " + column.name;
  }
  std::string text = rows.size() > 1 ? markdown(rows, 1) : "";
  for (const auto& [lack, metrics] : unmeasured)
    text += fmt::format("\nnot measured, needs {}:\n  {}\n", lack, metrics);
  return text;
}

void print(const Run& run, const Options& options) {
  const Recording& recording = run.recording;
  const auto counted = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  fmt::print("{}: {}, {} ticks of {:g} ms, {}\n\n", options.recording,
             counted(recording.joints.size(), "joint"), recording.ticks(), 1e3 * recording.dt(),
             counted(recording.joins.size(), "join"));
  if (!recording.joins.empty()) fmt::print("{}\n", joins_table(run));
  fmt::print("{}", run_table(run, options));
}

void measure_recording(const Options& options) {
  Run run;
  run.recording = read(options.recording, options.joins);
  if (!options.urdf.empty()) set_limits(own_or_given(options.urdf), run.recording);
  std::optional<Recording> half, compared;
  if (!options.half.empty()) half = read(options.half, options.joins);
  if (!options.compared.empty()) compared = read(options.compared, options.joins);
  run.metrics = measure(run.recording, {half ? &*half : nullptr, compared ? &*compared : nullptr},
                        options.settings);
  if (!options.json) return print(run, options);
  nlohmann::ordered_json json{{"format", 1}, {"recording", options.recording}};
  json.update(to_json(run));
  fmt::print("{}\n", json.dump(2));
}

}  // namespace

void add_metrics_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("metrics", "measure torque jumps and more on a recording");
  command
      .add_option("recording", options->recording,
                  "CSV: time [s] first, at even ticks; then any of torque.<joint> [N.m], "
                  "q.<joint>, ref.<joint> [rad], ref_acc.<joint> [rad/s2], switch")
      ->required();
  command
      .add_option("--join", options->joins,
                  "time of a join [s]; may be repeated (default: where the column switch changes)")
      ->allow_extra_args(false)
      ->delimiter(',');
  command.add_option("--half", options->half,
                     "the same run recorded at half the tick: gives the order of the jumps");
  command.add_option("--compare", options->compared,
                     "the same run with dmp2, or any other: gives the deviation from it");
  command.add_option("--urdf", options->urdf, "the robot: gives the joints' effort limits");
  MetricSettings& settings = options->settings;
  command
      .add_option("--line-ticks", settings.line_ticks,
                  "ticks of the lines that are carried to a join; noise of 1 N.m leaves 3.1 N.m of "
                  "3, 0.7 N.m of 20")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  command
      .add_option("--after-join", settings.after_join, "[s] in which tracking counts as the join's")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_flag("--json", options->json, "print JSON; null stands for what is not measured");
  command.footer(
      "Example: seam metrics results/line/dmp3.csv --join 1.25 --compare results/line/dmp2.csv");
  command.callback([options] { measure_recording(*options); });
}

}  // namespace seam
