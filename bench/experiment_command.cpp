#include "bench/experiment_command.hpp"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/experiment.hpp"
#include "bench/gnuplot.hpp"
#include "bench/names.hpp"
#include "bench/options.hpp"
#include "bench/progress.hpp"
#include "bench/results_folder.hpp"
#include "scenes/own_folders.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

struct Options {
  std::vector<std::string> experiments;
  std::string scene;
  std::vector<std::string> overrides, allowed;
  std::vector<double> values;
  int jobs = all_cores();
  std::string out = "results/experiments";
  bool list = false;
};

Experiment read(const std::string& file, const Options& options) {
  Experiment experiment = Experiment::read(file, options.allowed);
  if (!options.scene.empty()) {
    experiment.scene = scene_file(options.scene);
    experiment.overrides.clear();
  }
  experiment.overrides.insert(experiment.overrides.end(), options.overrides.begin(),
                              options.overrides.end());
  if (!options.values.empty()) experiment.values = options.values;
  if (!std::is_sorted(experiment.values.begin(), experiment.values.end()))
    throw Error("--values", "must increase");
  return experiment;
}

void answer_all(const Options& options) {
  std::vector<Experiment> experiments;
  for (const std::string& file : experiment_files(options.experiments))
    experiments.push_back(read(file, options));
  if (options.list) {
    for (const Experiment& experiment : experiments)
      fmt::print("{:18}  {}\n", experiment.name, experiment.title);
    return;
  }
  require_gnuplot();
  ResultsFolder folder(options.out);
  for (const Experiment& experiment : experiments) {
    ProgressLine line;
    const auto progress = [&](int done, int total) { line.show(done, total, experiment.name); };
    const std::vector<Measured> measured = perform(experiment, options.jobs, progress);
    folder.make();
    write_experiment(experiment, measured, options.out);
    fmt::print("{}\n\n{}\n\n{}\n{}/{}.png\n\n", experiment.title, answer(experiment, measured),
               table(experiment, measured), options.out, experiment.name);
  }
}

}  // namespace

void add_experiment_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "experiment", "vary one entry of a scene: a table and a plot of what comes of it");
  command.add_option("experiments", options->experiments,
                     "experiment files, or names of seam's own (default: all of those)");
  command.add_flag("--list", options->list, "name the experiments, a line each, and do none");
  command.add_option("--scene", options->scene, "your own scene instead of the experiment's");
  add_set_option(command, options->overrides);
  add_allow_option(command, options->allowed);
  command.add_option("--values", options->values, "values of what is varied, e.g. 0.5,1,1.5")
      ->allow_extra_args(false)
      ->delimiter(',');
  add_jobs_option(command, options->jobs);
  command.add_option("--out", options->out, "folder for the results")->capture_default_str();
  command.footer(
      "Example: seam experiment speed --scene my.yaml   # which join, for my robot, at my speed?");
  command.callback([options] { answer_all(*options); });
}

}  // namespace seam
