#include "bench/bench_command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/columns.hpp"
#include "bench/compare.hpp"
#include "bench/gate.hpp"
#include "bench/gnuplot.hpp"
#include "bench/names.hpp"
#include "bench/options.hpp"
#include "bench/page.hpp"
#include "bench/progress.hpp"
#include "bench/report.hpp"
#include "bench/results_folder.hpp"
#include "scenes/own_folders.hpp"
#include "scenes/reality.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr const char* published = "published";
constexpr const char* both = "both";

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> methods;
  std::optional<double> dt;  // [s]
  std::vector<double> speeds;
  std::optional<std::string> arm;  // nothing: the scene's
  std::vector<std::string> overrides, allowed;
  bool list = false;
  int jobs = all_cores();
  std::string out = "results";
  std::string baselines;  // folder; empty: none
  bool update = false;
  bool alone = false;  // one run, seam run
};

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

// What a scene is on another arm; the arm is told by itself, and not among what was set anew.
Scene read_on(const std::optional<std::string>& arm, const std::string& file,
              const std::vector<std::string>& overrides, const Options& options) {
  std::vector<std::string> all = overrides;
  if (arm) all.push_back("arm=" + *arm);
  Scene scene = Scene::read(file, all, options.allowed);
  scene.overrides = overrides;
  return scene;
}

// The ideal arm, and the one that the scene names or that is published of its robot.
std::vector<Scene> read_on_both(const std::string& file, const std::vector<std::string>& overrides,
                                const Options& options) {
  const Scene own = read_on({}, file, overrides, options);
  if (own.arm != ideal_arm) return {read_on(ideal_arm, file, overrides, options), own};
  if (!std::filesystem::exists(named_arm(own.urdf, published))) return {own};
  return {own, read_on(published, file, overrides, options)};
}

std::vector<Scene> read_scenes(const Options& options) {
  std::vector<Scene> scenes;
  std::set<std::string> seen;
  for (const std::string& file : scene_files(options.scenes))
    for (const auto& overrides : overrides_of(options))
      for (Scene& scene : options.arm == both
                              ? read_on_both(file, overrides, options)
                              : std::vector{read_on(options.arm, file, overrides, options)}) {
        if (scene.speed != 1.0) scene.name += fmt::format("-{:g}x", scene.speed);
        const std::string name = on_arm(scene.name, scene.arm);
        if (!seen.insert(name).second) throw Error("scene \"" + name + "\"", "given twice");
        scenes.push_back(std::move(scene));
      }
  return scenes;
}

void list_scenes(Options options) {
  options.arm.reset();
  for (const Scene& scene : read_scenes(options))
    fmt::print("{:10}  {}\n", scene.name, scene.title);
}

// Which were to be played on two arms, and have but one.
void print_lonely(const std::vector<Scene>& scenes) {
  for (const Scene& scene : scenes) {
    const auto same = [&](const Scene& other) { return other.name == scene.name; };
    if (std::count_if(scenes.begin(), scenes.end(), same) == 1)
      fmt::print("{}: on the ideal arm only, there is no {}\n", scene.name,
                 named_arm(scene.urdf, published));
  }
}

std::string own_method(const Options& options) {
  const std::string& scene = options.scenes[0];
  const auto method = read_on(options.arm, scene_file(scene), options.overrides, options).method;
  if (!method)
    throw Error(scene, "has no key \"method\", needs --method dmp2, dmp2a, dmp3 or dmp2j");
  return std::string(to_string(*method));
}

void print(const Comparison& comparison) {
  const Scene& scene = comparison.scene;
  fmt::print("{}: {} (dt {:g} ms)\n\n{}\n", on_arm(scene.name, scene.arm), title_on_arm(scene),
             scene.dt * 1e3, table(comparison));
  for (const Run& run : comparison.runs)
    if (!run.recording.incident.empty())
      fmt::print("{}: {}\n", to_string(run.method), run.recording.incident);
  fmt::print("played at");
  for (const Run& run : comparison.runs)
    fmt::print(" {} {:.0f}x{}", to_string(run.method), run.real_time_factor,
               &run == &comparison.runs.back() ? " real time\n\n" : ",");
}

// One run would take the place of what a bench has compared.
void require_no_comparison(const std::string& results) {
  const std::string path = (std::filesystem::path(results) / "summary.json").string();
  if (!std::filesystem::exists(path)) return;
  const auto json = nlohmann::json::parse(std::ifstream(path), nullptr, false);
  if (json.is_object() && json.contains("runs") && json["runs"].size() > 1)
    throw Error(results, "holds what seam bench has compared, needs another folder (--out)");
}

// Whether all figures are as in the baselines, or they are renewed.
bool check(const std::vector<Comparison>& comparisons, Baselines& baselines,
           const Options& options) {
  const Figures now = figures(comparisons);
  const std::vector<Difference> differences = baselines.check(now);
  for (const Difference& difference : differences) fmt::print("{}\n", to_string(difference));
  fmt::print("{}: {} figures differ by more than allowed{}\n", options.baselines,
             differences.size(), options.update ? ", and are renewed" : "");
  if (options.update) baselines.update(now);
  return differences.empty() || options.update;
}

bool bench(const Options& options) {
  if (options.update && options.baselines.empty())
    throw Error("--update", "needs --check, which names the baselines");
  if (options.list) {
    list_scenes(options);
    return true;
  }
  std::optional<Baselines> baselines;
  if (!options.baselines.empty())
    baselines.emplace(options.update ? options.baselines : own_or_given(options.baselines));
  require_gnuplot();
  const std::vector<Scene> scenes = read_scenes(options);
  const std::vector<Join> methods = read_methods(options.methods);
  ResultsFolder folder(options.out);
  if (options.alone) require_no_comparison(options.out);
  ProgressLine line;
  const auto comparisons =
      compare(scenes, methods, options.jobs,
              [&](int done, int total, const std::string& what) { line.show(done, total, what); });
  folder.make();
  write_results(comparisons, SEAM_VERSION, options.out, options.jobs);
  for (const Comparison& comparison : comparisons) print(comparison);
  if (comparisons.size() > 1) fmt::print("{}\n", overview(comparisons));
  if (options.arm == both) print_lonely(scenes);
  fmt::print("{}/: summary.json; per scene a recording of each method (CSV) and pictures (PNG)\n",
             options.out);
  const std::string page = (std::filesystem::path(options.out) / "report.html").string();
  write_page(options.out, page);
  fmt::print("{}: all of it to look at, in any browser\n", page);
  return !baselines || check(comparisons, *baselines, options);
}

void add_common(CLI::App& command, Options& options) {
  command.add_option("--dt", options.dt, "Bullet's tick [s] (default: the scene's)")
      ->check(CLI::Number & CLI::Range(least_tick, largest_tick));
  command
      .add_option("--speed", options.speeds,
                  "factors by which all is played faster; several are compared")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(CLI::Number & CLI::Range(1e-3, 1e3));
  add_set_option(command, options.overrides);
  add_allow_option(command, options.allowed);
  add_jobs_option(command, options.jobs);
  command.add_option("--out", options.out, "folder for the results")->capture_default_str();
}

void bench_and_exit(const Options& options) {
  if (!bench(options)) throw CLI::RuntimeError(1);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  options->arm = both;
  CLI::App& command = *app.add_subcommand("bench", "play scenes with every method and compare");
  command.add_option("scenes", options->scenes,
                     "scene files, or names of seam's own (default: all of those)");
  command
      .add_option("--method", options->methods,
                  "joining method: dmp2, dmp2a, dmp3, dmp2j (default: all)")
      ->allow_extra_args(false)
      ->delimiter(',');
  command.add_option("--arm", options->arm,
                     "arm: ideal, published, both (default: both; the second is the scene's own, "
                     "if it names one), or NAME: NAME.yaml beside the robot's URDF");
  command.add_flag("--list", options->list, "name the scenes, a line each, and play none");
  command.add_option("--check", options->baselines,
                     "folder of baselines; figures that differ from them are named, exit code 1");
  command.add_flag("--update", options->update, "renew the baselines and show what differed");
  add_common(command, *options);
  command.callback([options] { bench_and_exit(*options); });
}

void add_run_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  options->out = "results/run";
  CLI::App& command = *app.add_subcommand("run", "play one scene with one method");
  command.add_option("scene", options->scenes, "scene file, or name of one of seam's own")
      ->required()
      ->expected(1);
  command
      .add_option("--method", options->methods,
                  "joining method: dmp2, dmp2a, dmp3, dmp2j (default: the scene's)")
      ->expected(1);
  command.add_option("--arm", options->arm,
                     "arm: ideal, published (default: the scene's, else ideal), or NAME: NAME.yaml "
                     "beside the robot's URDF");
  add_common(command, *options);
  command.callback([options] {
    options->alone = true;
    if (options->arm == both) throw Error("--arm", "\"both\", seam run plays on one");
    if (options->methods.empty()) options->methods = {own_method(*options)};
    bench_and_exit(*options);
  });
}

}  // namespace seam
