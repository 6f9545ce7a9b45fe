#include "bench/metrics_command.hpp"

#include <cmath>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/columns.hpp"
#include "bench/markdown.hpp"
#include "bench/run_json.hpp"
#include <seam/error.hpp>
#include <seam/robot_model.hpp>

namespace seam {

namespace {

struct Options {
  std::string recording, half, dmp2, urdf;
  std::vector<double> joins;  // [s]
  bool json = false;
};

Recording read(const std::string& path, const std::vector<double>& joins) {
  Recording recording = Recording::read(path);
  if (joins.empty()) return recording;
  recording.joins.clear();
  const double end = recording.time(recording.ticks() - 1);
  for (const double time : joins) {
    if (!(time >= recording.time(0) && time <= end))
      throw Error("--join", fmt::format("{} s, must be within the recording, {} to {} s", time,
                                        recording.time(0), end));
    recording.joins.push_back(recording.estimated_join(time, 0));
  }
  return recording;
}

void set_limits(const std::string& urdf, Recording& recording) {
  const RobotModel robot = RobotModel::read(urdf);
  for (std::size_t i = 0; i < recording.joints.size(); ++i)
    recording.effort(static_cast<Eigen::Index>(i)) =
        robot.joints[static_cast<std::size_t>(robot.joint(recording.joints[i]))].effort;
}

std::string joins_table(const Run& run) {
  const std::vector<JoinColumn> list = join_columns(run.recording);
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

std::string run_table(const Run& run, std::string& unmeasured) {
  Rows rows{{"metric", "value"}};
  for (const Column& column : columns(run.recording)) {
    const double value = column.of(run);
    if (std::isnan(value))
      unmeasured += (unmeasured.empty() ? "" : ", ") + column.name;
    else
      rows.push_back({column.heading, shown(value, column.format)});
  }
  return markdown(rows, 1);
}

void measure_recording(const Options& options) {
  Run run;
  run.recording = read(options.recording, options.joins);
  if (!options.urdf.empty()) set_limits(options.urdf, run.recording);
  std::optional<Recording> half, dmp2;
  if (!options.half.empty()) half = read(options.half, options.joins);
  if (!options.dmp2.empty()) dmp2 = read(options.dmp2, options.joins);
  const double ratio = half ? run.recording.dt() / half->dt() : 2.0;
  if (std::abs(ratio - 2.0) > 1e-3)
    throw Error(options.half, fmt::format("a tick of {:g} s, must be {:g} s, half of the other's",
                                          half->dt(), 0.5 * run.recording.dt()));
  run.metrics = measure(run.recording, {half ? &*half : nullptr, dmp2 ? &*dmp2 : nullptr});
  if (options.json) {
    nlohmann::ordered_json json{{"format", 1}};
    json.update(to_json(run));
    fmt::print("{}\n", json.dump(2));
    return;
  }
  const Recording& recording = run.recording;
  fmt::print("{}: {} joints, {} ticks of {:g} ms, {} joins\n\n", options.recording,
             recording.joints.size(), recording.ticks(), 1e3 * recording.dt(),
             recording.joins.size());
  if (!recording.joins.empty()) fmt::print("{}\n", joins_table(run));
  std::string unmeasured;
  fmt::print("{}\n", run_table(run, unmeasured));
  if (!unmeasured.empty()) fmt::print("not measured: {}\n", unmeasured);
}

}  // namespace

void add_metrics_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("metrics", "measure torque jumps and more on a recording");
  command
      .add_option("recording", options->recording,
                  "CSV: time [s] first, torque.<joint> [N.m]; optional q.<joint>, ref.<joint>, "
                  "ref_acc.<joint>, switch")
      ->required();
  command
      .add_option("--join", options->joins,
                  "time of a join [s]; may be repeated (default: where the column switch changes)")
      ->allow_extra_args(false)
      ->delimiter(',');
  command.add_option("--half", options->half,
                     "the same run recorded at half the tick: gives the order of the jumps");
  command.add_option("--dmp2", options->dmp2,
                     "the same run with dmp2, or any other: gives the deviation from it");
  command.add_option("--urdf", options->urdf, "the robot: gives the joints' effort limits");
  command.add_flag("--json", options->json, "print JSON; null stands for what is not measured");
  command.footer(
      "Example: seam metrics results/line/dmp3.csv --join 1.25 --dmp2 results/line/dmp2.csv");
  command.callback([options] { measure_recording(*options); });
}

}  // namespace seam
