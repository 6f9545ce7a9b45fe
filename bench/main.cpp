#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
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
  std::optional<double> dt;  // [s]
  std::vector<double> speeds;
  std::vector<std::string> overrides;
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

// What is set anew in each scene, at each speed.
std::vector<std::vector<std::string>> overrides_of(const Options& options) {
  std::vector<std::string> all = options.overrides;
  if (options.dt) all.push_back(fmt::format("dt={}", *options.dt));
  if (options.speeds.empty()) return {all};
  std::vector<std::vector<std::string>> each(options.speeds.size(), all);
  for (std::size_t i = 0; i < each.size(); ++i)
    each[i].push_back(fmt::format("speed={}", options.speeds[i]));
  return each;
}

std::vector<seam::Scene> read_scenes(const Options& options) {
  std::vector<seam::Scene> scenes;
  std::set<std::string> seen;
  for (const std::string& name : options.scenes.empty() ? own_scenes() : options.scenes)
    for (const auto& overrides : overrides_of(options)) {
      seam::Scene& scene = scenes.emplace_back(seam::Scene::read(scene_file(name), overrides));
      if (scene.speed != 1.0) scene.name += fmt::format("-{:g}x", scene.speed);
      if (!seen.insert(scene.name).second)
        throw seam::Error("scene \"" + scene.name + "\"", "given twice");
    }
  return scenes;
}

void list_scenes(const Options& options) {
  for (const seam::Scene& scene : read_scenes(options))
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
             comparison.scene.dt * 1e3, seam::table(comparison));
  fmt::print("played at");
  for (const seam::Run& run : comparison.runs)
    fmt::print(" {} {:.0f}x{}", seam::to_string(run.method), run.real_time_factor,
               &run == &comparison.runs.back() ? " real time\n\n" : ",");
}

void bench(const Options& options) {
  if (options.out.empty()) throw seam::Error("--out", "is empty, must be a folder");
  if (options.list) return list_scenes(options);
  seam::require_gnuplot();
  const auto comparisons = seam::compare(read_scenes(options), read_methods(options.methods),
                                         options.jobs, show_progress);
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
  command
      .add_option("--set", options.overrides,
                  "key=value: an entry of the scene file set anew, e.g. actuator.lag=0.002 or "
                  "sequence.steps.0.until={after: 0.6}; may be repeated")
      ->allow_extra_args(false);
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
