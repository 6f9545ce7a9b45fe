#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/columns.hpp"
#include "bench/compare.hpp"
#include "bench/figure.hpp"
#include "bench/learn_command.hpp"
#include "bench/report.hpp"
#include "bench/rollout_command.hpp"
#include <seam/error.hpp>

namespace {

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> methods;
  double dt = 0.0;  // [s] 0: the scene's own
  std::vector<double> speeds{1.0};
  bool list = false;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::string out = "results";
};

// A scene is a file, or the name of one of the project's own.
std::string scene_file(const std::string& scene) {
  if (std::filesystem::is_regular_file(scene) || scene.find_first_of("./") != std::string::npos)
    return scene;
  return std::string(SEAM_SCENES) + "/" + scene + ".yaml";
}

std::vector<std::string> own_scenes() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(SEAM_SCENES))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<seam::Scene> read_scenes(const std::vector<std::string>& names) {
  std::vector<seam::Scene> scenes;
  std::set<std::string> seen;
  for (const std::string& name : names.empty() ? own_scenes() : names) {
    scenes.push_back(seam::Scene::read(scene_file(name)));
    if (!seen.insert(scenes.back().name).second)
      throw seam::Error("scene \"" + scenes.back().name + "\"", "given twice");
  }
  return scenes;
}

// Each scene at each speed.
std::vector<seam::Scene> at_speeds(const std::vector<seam::Scene>& scenes,
                                   const std::vector<double>& speeds) {
  std::vector<seam::Scene> played;
  for (const seam::Scene& scene : scenes)
    for (const double speed : speeds) {
      played.push_back(scene);
      played.back().hasten(speed);
      if (speed != 1.0) played.back().name += fmt::format("-{:g}x", speed);
    }
  return played;
}

void list_scenes(const std::vector<std::string>& names) {
  for (const seam::Scene& scene : read_scenes(names))
    fmt::print("{:10}  {}\n", scene.name, scene.title);
}

std::vector<seam::Join> read_methods(const std::vector<std::string>& names) {
  std::vector<seam::Join> methods;
  for (const std::string& name : names) methods.push_back(seam::join_from_name(name));
  if (names.empty()) methods.assign(seam::all_joins.begin(), seam::all_joins.end());
  return methods;
}

std::string own_method(const std::string& scene) {
  const auto method = seam::Scene::read(scene_file(scene)).method;
  if (!method)
    throw seam::Error(scene, "has no key \"method\", needs --method dmp2, dmp2a, dmp3 or dmp2j");
  return std::string(seam::to_string(*method));
}

void show_progress(int done, int total, const std::string& what) {
  if (!isatty(STDERR_FILENO)) return;
  fmt::print(stderr, "\r\033[K{}/{} {}{}", done, total, what, done == total ? "\r\033[K" : "");
  std::fflush(stderr);
}

void print(const seam::Comparison& comparison) {
  fmt::print("{}: {} (dt {:g} ms)\n\n{}\n", comparison.scene.name, comparison.scene.title,
             comparison.dt * 1e3, seam::table(comparison));
  fmt::print("played at");
  for (const seam::Run& run : comparison.runs)
    fmt::print(" {} {:.0f}x{}", seam::to_string(run.method), run.real_time_factor,
               &run == &comparison.runs.back() ? " real time\n\n" : ",");
}

void bench(const Options& options) {
  if (options.out.empty()) throw seam::Error("--out", "is empty, must be a folder");
  if (std::isnan(options.dt)) throw seam::Error("--dt", "nan, must be a time [s]");
  if (options.list) return list_scenes(options.scenes);
  seam::require_gnuplot();
  const auto comparisons =
      seam::compare(at_speeds(read_scenes(options.scenes), options.speeds),
                    read_methods(options.methods), options.dt, options.jobs, show_progress);
  seam::write_results(comparisons, SEAM_VERSION, options.out);
  for (const seam::Comparison& comparison : comparisons) {
    print(comparison);
    seam::draw_figures(comparison, options.out);
  }
  if (comparisons.size() > 1) fmt::print("{}\n", seam::overview(comparisons));
  fmt::print("{}/: summary.json; per scene a recording of each method (CSV) and pictures (PNG)\n",
             options.out);
}

void add_common(CLI::App& command, Options& options) {
  command.add_option("--dt", options.dt, "Bullet's tick [s] (default: the scene's)")
      ->check(CLI::Number & CLI::Range(seam::least_tick, seam::largest_tick));
  command
      .add_option("--speed", options.speeds,
                  "factors by which all is played faster; several are compared")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(CLI::Number & CLI::Range(1e-3, 1e3));
  command.add_option("--jobs", options.jobs, "threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("--out", options.out, "folder for the results")->capture_default_str();
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"seam: movement primitives on a Bullet arm, joined without a step in torque"};
  app.require_subcommand(1);
  app.set_version_flag("--version", SEAM_VERSION);

  CLI::App& compare = *app.add_subcommand("bench", "play scenes with every method and compare");
  compare.add_option("scenes", options.scenes,
                     "scene files, or names of seam's own (default: all of those)");
  compare
      .add_option("--method", options.methods,
                  "joining method: dmp2, dmp2a, dmp3, dmp2j (default: all)")
      ->allow_extra_args(false)
      ->delimiter(',');
  compare.add_flag("--list", options.list, "name the scenes, a line each, and play none");
  add_common(compare, options);

  CLI::App& single = *app.add_subcommand("run", "play one scene with one method");
  single.add_option("scene", options.scenes, "scene file, or name of one of seam's own")
      ->required()
      ->expected(1);
  single
      .add_option("--method", options.methods,
                  "joining method: dmp2, dmp2a, dmp3, dmp2j (default: the scene's)")
      ->expected(1);
  add_common(single, options);

  seam::add_learn_command(app);
  seam::add_rollout_command(app);

  try {
    app.parse(argc, argv);
    if (single.parsed() && options.methods.empty())
      options.methods = {own_method(options.scenes[0])};
    if (compare.parsed() || single.parsed()) bench(options);
    if (std::fflush(stdout) != 0) throw seam::Error("standard output", "cannot be written");
    return 0;
  } catch (const CLI::Success& shown) {
    return app.exit(shown);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "seam: {} (see seam --help)\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "seam: {}\n", error.what());
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv);
}
