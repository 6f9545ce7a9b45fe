#include "bench/figure.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include <seam/error.hpp>
#include <seam/execution.hpp>
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

std::string file_of(const Scene& scene, std::size_t step) {
  return fmt::format("primitive-{}-{}.csv", step + 1, scene.primitive_names[step]);
}

bool moves(const Primitive& primitive, const std::string& joint) {
  for (const std::string& coordinate : primitive.coordinates)
    if (coordinate == joint) return true;
  return false;
}

void write_primitives(const Comparison& comparison, const std::string& folder) {
  double begin = comparison.scene.sequence.start_delay();
  const auto& steps = comparison.scene.sequence.steps();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    alone(steps[i].primitive, begin, comparison.dt)
        .write(folder + "/" + file_of(comparison.scene, i));
    begin += steps[i].until.due(steps[i].primitive.tau);
  }
}

std::string style(Join method) {
  switch (method) {
    case Join::dmp2:
      return "lc rgb '#d55e00' lw 2.5 dt 1";
    case Join::dmp2a:
      return "lc rgb '#0072b2' lw 2.5 dt 1";
    case Join::dmp3:
      return "lc rgb '#009e73' lw 2.5 dt (8,5)";
  }
  return "";
}

// One curve per method of a recording's column; `x` is gnuplot's.
std::string curves(const Comparison& comparison, const std::string& x, const std::string& column,
                   int every, const char* with) {
  std::string text;
  for (const Run& run : comparison.runs)
    text += fmt::format("{}'{}.csv' every {} using {}:'{}' with {} {} title '{}'",
                        text.empty() ? "" : ", \\\n  ", to_string(run.method), every, x, column,
                        with, style(run.method), to_string(run.method));
  return text;
}

std::string preamble(const Comparison& comparison, const std::string& picture, int width,
                     int height) {
  std::string text = fmt::format(
      "set terminal pngcairo size {},{} font 'DejaVu Sans,18' background rgb 'white'\n"
      "set output '{}'\n"
      "set datafile separator ','\n"
      "set datafile columnheaders\n"
      "set grid lc rgb '#dddddd'\n"
      "set border 3\nset tics nomirror\n"
      "set lmargin 11\nset rmargin 3\nset key tmargin right horizontal samplen 2 width -3\n",
      width, height, picture);
  for (const RecordedJoin& join : comparison.runs.front().recording.joins)
    text += fmt::format(
        "set arrow from {0}, graph 0 to {0}, graph 1 nohead dt 3 lw 2 lc rgb '#555555'\n",
        join.time);
  return text;
}

std::string sequencing_script(const Comparison& comparison) {
  const Scene& scene = comparison.scene;
  const Recording& recording = comparison.runs.front().recording;
  const int every = std::max(1, recording.ticks() / curve_points);
  std::string text = preamble(comparison, scene.name + ".png", 1200, 1440);
  text += fmt::format("set xrange [0:{}]\n", recording.time(recording.ticks() - 1));
  text += fmt::format("set multiplot layout 4,1 title '{}, joint {}'\n", scene.title, scene.figure);
  text += "set ylabel 'each alone [rad]'\nplot ";
  for (std::size_t i = 0; i < scene.primitive_names.size(); ++i)
    if (moves(scene.sequence.steps()[i].primitive, scene.figure))
      text += fmt::format("{}'{}' using 'time':'{}' with lines lw 2.5 lc rgb '{}' title '{}'",
                          i ? ", \\\n  " : "", file_of(scene, i), scene.figure,
                          i % 2 ? "#999999" : "#333333", scene.primitive_names[i]);
  const std::pair<const char*, const char*> panels[] = {{"joined position [rad]", "ref."},
                                                        {"velocity [rad/s]", "ref_vel."},
                                                        {"acceleration [rad/s²]", "ref_acc."}};
  for (const auto& [label, prefix] : panels) {
    if (prefix == panels[2].second) text += "\nset xlabel 'time [s]'";
    text += fmt::format("\nset ylabel '{}'\nplot {}\n{}", label,
                        curves(comparison, "'time'", prefix + scene.figure, every, "lines"),
                        prefix == panels[0].second ? "unset key" : "");
  }
  return text + "unset multiplot\n";
}

std::string torque_script(const Comparison& comparison) {
  const Scene& scene = comparison.scene;
  const Recording& recording = comparison.runs.front().recording;
  const int every = std::max(1, recording.ticks() / curve_points);
  const double join = recording.joins.back().time;
  const double reach = 20e3 * comparison.dt;  // [ms]
  const std::string column = "torque." + scene.figure;
  std::string text = preamble(comparison, "torque.png", 1200, 520);
  text += "set multiplot layout 1,2\nset xlabel 'time [s]'\n";
  text += fmt::format("set ylabel 'torque of {} [N·m]'\nset xrange [0:{}]\nplot {}\n", scene.figure,
                      recording.time(recording.ticks() - 1),
                      curves(comparison, "'time'", column, every, "lines"));
  text +=
      "unset key\nset xlabel 'from the last join [ms], every tick'\nset ylabel ''\nunset arrow\n";
  text += "set arrow from 0, graph 0 to 0, graph 1 nohead dt 3 lw 2 lc rgb '#555555'\n";
  text += fmt::format("set xtics {}\nset xrange [{}:{}]\n", reach / 2.0, -reach, reach);
  const std::string from_join = fmt::format("(1e3*(column('time')-{}))", join);
  return text + fmt::format("plot {}\nunset multiplot\n",
                            curves(comparison, from_join, column, 1, "linespoints pt 7 ps 0.8"));
}

void draw(const std::string& folder, const std::string& script_name, const std::string& script) {
  write_whole(folder + "/" + script_name, script);
  const std::string command =
      fmt::format("cd '{}' && gnuplot '{}' >gnuplot.log 2>&1 </dev/null", folder, script_name);
  if (std::system(command.c_str()) != 0)
    throw Error(
        folder + "/" + script_name,
        "gnuplot is not installed (Debian: gnuplot-nox) or fails, see gnuplot.log beside it");
  std::filesystem::remove(folder + "/gnuplot.log");
}

}  // namespace

void draw_figures(const Comparison& comparison, const std::string& dir) {
  const std::string folder = dir + "/" + comparison.scene.name;
  write_primitives(comparison, folder);
  draw(folder, comparison.scene.name + ".gnuplot", sequencing_script(comparison));
  draw(folder, "torque.gnuplot", torque_script(comparison));
}

}  // namespace seam
