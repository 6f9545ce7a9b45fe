#include "bench/figure.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "bench/gnuplot.hpp"
#include <seam/error.hpp>
#include <seam/execution.hpp>
#include <seam/metrics.hpp>
#include <seam/table.hpp>

namespace seam {

namespace {

constexpr int curve_points = 1000;

// A primitive on its own, from its own start, at the time at which the sequence begins it.
Table alone(const Primitive& primitive, double begin, double dt) {
  const int ticks = static_cast<int>(primitive.tau / dt) + 1;
  Table table{{"time"}, Eigen::MatrixXd(ticks, 1 + primitive.dimensions())};
  table.columns.insert(table.columns.end(), primitive.coordinates.begin(),
                       primitive.coordinates.end());
  Execution execution(primitive);
  for (int k = 0; k < ticks; ++k) {
    table.values(k, 0) = begin + k * dt;
    table.values.row(k).tail(primitive.dimensions()) = execution.sample().position;
    execution.step(dt);
  }
  return table;
}

std::string file_of(std::size_t step) {
  return fmt::format("primitive-{}.csv", step + 1);
}

void write_primitives(const Comparison& comparison, const std::string& folder) {
  const auto& joins = comparison.runs.front().recording.joins;
  const auto& steps = comparison.scene.sequence.steps();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto begun = std::find_if(joins.begin(), joins.end(), [&](const RecordedJoin& join) {
      return join.primitive == static_cast<int>(i);
    });
    const double begin = begun == joins.end() ? 0.0 : begun->time;
    alone(steps[i].primitive, begin, comparison.scene.dt).write(folder + "/" + file_of(i));
  }
}

// One curve per method of a recording's column; `x` is gnuplot's.
std::string curves(const Comparison& comparison, const std::string& x, const std::string& column,
                   int every, const char* with) {
  std::string text;
  for (const Run& run : comparison.runs)
    text += fmt::format("{}'{}.csv' every {} using {}:{} with {} {} title '{}'",
                        text.empty() ? "" : ", \\\n  ", to_string(run.method), every, x,
                        quoted(column), with, style(run.method), to_string(run.method));
  return text;
}

// With a dotted line at each join.
std::string with_joins(const Comparison& comparison, int width, int height) {
  std::string text = preamble(width, height);
  for (const RecordedJoin& join : comparison.runs.front().recording.joins)
    text += fmt::format(
        "set arrow from {0}, graph 0 to {0}, graph 1 nohead dt 3 lw 2 lc rgb '#555555'\n",
        join.time);
  return text;
}

const char* unit(const Scene& scene) {
  const std::string& name = scene.figure;
  return scene.tool && (name == "x" || name == "y" || name == "z") ? "m" : "rad";
}

// In task space that whose torque the joins disturb most.
std::string torque_joint(const Comparison& comparison) {
  const Recording& recording = comparison.runs.front().recording;
  if (!recording.in_task_space()) return comparison.scene.figure;
  std::vector<double> joins;
  for (const RecordedJoin& join : recording.joins) joins.push_back(join.time);
  return recording.joints[most_disturbed_joint(recording.time, recording.torque, joins)];
}

std::string sequencing_script(const Comparison& comparison) {
  const Scene& scene = comparison.scene;
  const Recording& recording = comparison.runs.front().recording;
  const int every = std::max(1, recording.ticks() / curve_points);
  std::string text = with_joins(comparison, 1200, 1440);
  text += fmt::format("set xrange [0:{}]\n", recording.time(recording.ticks() - 1));
  text +=
      "set multiplot layout 4,1 title " + quoted(title_on_arm(scene) + ", " + scene.figure) + "\n";
  const std::string u = unit(scene);
  text += "set ylabel 'each alone [" + u + "]'\nplot ";
  for (std::size_t i = 0; i < scene.primitive_names.size(); ++i)
    text += fmt::format("{}'{}' using 'time':{} with lines lw 2.5 lc rgb '{}' title {}",
                        i ? ", \\\n  " : "", file_of(i), quoted(scene.figure),
                        i % 2 ? "#999999" : "#333333", quoted(scene.primitive_names[i]));
  const std::pair<std::string, std::string> panels[] = {
      {"joined position [" + u + "]", "ref."},
      {"velocity [" + u + "/s]", "ref_vel."},
      {"acceleration [" + u + "/s²]", "ref_acc."}};
  for (const auto& [label, prefix] : panels) {
    if (prefix == panels[2].second) text += "\nset xlabel 'time [s]'";
    text += fmt::format("\nset ylabel '{}'\nplot {}\n{}", label,
                        curves(comparison, "'time'", prefix + scene.figure, every, "lines"),
                        prefix == panels[0].second ? "unset key" : "");
  }
  return text + "unset multiplot\n";
}

std::string torque_script(const Comparison& comparison) {
  const std::string joint = torque_joint(comparison);
  const Recording& recording = comparison.runs.front().recording;
  const int every = std::max(1, recording.ticks() / curve_points);
  const double join = recording.joins.back().time;
  const double reach = 20e3 * comparison.scene.dt;  // [ms]
  const std::string column = "torque." + joint;
  std::string text = with_joins(comparison, 1200, 520);
  text += "set multiplot layout 1,2\nset xlabel 'time [s]'\nunset key\nset tmargin 3\n";
  text += "set ylabel " + quoted("torque of " + joint + " [N·m]") + "\n";
  text += fmt::format("set xrange [0:{}]\nplot {}\n", recording.time(recording.ticks() - 1),
                      curves(comparison, "'time'", column, every, "lines"));
  text += "set key at screen 0.98, screen 0.97 right horizontal maxrows 1 samplen 2\n";
  text += "set xlabel 'from the last join [ms], every tick'\nset ylabel ''\nunset arrow\n";
  text += "set arrow from 0, graph 0 to 0, graph 1 nohead dt 3 lw 2 lc rgb '#555555'\n";
  text += fmt::format("set xtics {}\nset xrange [{}:{}]\n", reach / 2.0, -reach, reach);
  const std::string from_join = fmt::format("(1e3*(column('time')-{}))", join);
  return text + fmt::format("plot {}\nunset multiplot\n",
                            curves(comparison, from_join, column, 1, "linespoints pt 7 ps 0.8"));
}

std::string signal_script(const Comparison& comparison, const Signal& signal) {
  const Recording& recording = comparison.runs.front().recording;
  const int every = std::max(1, recording.ticks() / curve_points);
  std::string text = with_joins(comparison, 1200, 520);
  if (comparison.scene.liquid)
    text += fmt::format(
        "set arrow from graph 0, first {0} to graph 1, first {0} nohead lw 2 lc rgb '#888888'\n",
        comparison.scene.liquid->rim);
  text += fmt::format("set xlabel 'time [s]'\nset ylabel {}\nset xrange [0:{}]\nplot {}\n",
                      quoted(signal.name), recording.time(recording.ticks() - 1),
                      curves(comparison, "'time'", signal.name, every, "lines"));
  return text;
}

}  // namespace

std::size_t most_disturbed_joint(const Eigen::VectorXd& time, const Eigen::MatrixXd& torque,
                                 const std::vector<double>& joins) {
  Eigen::VectorXd worst = Eigen::VectorXd::Zero(torque.cols());
  for (const double join : joins) {
    const Eigen::VectorXd step = jump(time, torque, join).cwiseAbs();
    if (step.allFinite()) worst = worst.cwiseMax(step);
  }
  Eigen::Index joint = 0;
  worst.maxCoeff(&joint);
  return static_cast<std::size_t>(joint);
}

void draw_figures(const Comparison& comparison, const std::string& dir) {
  const std::string name = on_arm(comparison.scene.name, comparison.scene.arm);
  const std::string folder = (std::filesystem::path(dir) / name).string();
  write_primitives(comparison, folder);
  draw(folder, name, sequencing_script(comparison));
  draw(folder, "torque", torque_script(comparison));
  for (const Signal& signal : comparison.runs.front().recording.signals)
    draw(folder, signal.name, signal_script(comparison, signal));
}

}  // namespace seam
