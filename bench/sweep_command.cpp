#include "bench/sweep_command.hpp"

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/names.hpp"
#include "bench/options.hpp"
#include "bench/progress.hpp"
#include "bench/sweep.hpp"
#include "scenes/own_folders.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

struct Options {
  std::string scene;
  std::vector<std::string> vary, overrides, allowed, methods, merge;
  std::optional<std::int64_t> samples;
  std::uint64_t seed = 1;
  std::string shard = "0/1";
  int jobs = all_cores();
  std::string out;
};

SweepPlan read_plan(const Options& options) {
  SweepPlan plan;
  bool draws = false;
  for (const std::string& text : options.vary) {
    plan.variations.push_back(Variation::read(text));
    draws |= plan.variations.back().drawn();
  }
  if (draws && !options.samples)
    throw Error("--samples", "is missing: how many values are drawn for keys given as a:b");
  if (!draws && options.samples) throw Error("--samples", "draws nothing: no key is varied as a:b");
  plan.draws = options.samples.value_or(1);
  plan.seed = options.seed;
  plan.methods = read_methods(options.methods);
  return plan;
}

void sweep(const Options& options) {
  const Shard shard = Shard::read(options.shard);
  const Sweep sweep(scene_file(options.scene), options.overrides, options.allowed,
                    read_plan(options), SEAM_VERSION);
  const SweepContents contents = sweep.contents(shard);
  SweepFile file(options.out, contents);
  const std::int64_t before = file.done();
  ProgressLine line(before);
  run_sweep(sweep, shard, options.jobs, file,
            [&](std::int64_t done, std::int64_t total) { line.show(done, total, "samples"); });
  fmt::print("{}: {} samples, each with {} methods", options.out, contents.size(),
             contents.plan.methods.size());
  if (before > 0) fmt::print("; {} were there already", before);
  if (file.refused() > 0)
    fmt::print("; {} were refused by the scene, their status says why", file.refused());
  fmt::print("\n");
}

void sweep_or_merge(const Options& options) {
  if (options.out.empty()) throw Error("--out", "is empty, must be a file");
  if (options.merge.empty()) {
    if (options.scene.empty()) throw Error("seam sweep", "needs a scene, or --merge");
    return sweep(options);
  }
  if (!options.scene.empty() || !options.vary.empty())
    throw Error("--merge", "plays nothing: leave out scene and --vary");
  const SweepContents contents = merge_sweeps(options.merge, options.out);
  fmt::print("{}: {} samples, each with {} methods, of {} parts\n", options.out, contents.size(),
             contents.plan.methods.size(), options.merge.size());
}

void add_what(CLI::App& command, Options& options) {
  command.add_option("scene", options.scene, "scene file, or name of one of seam's own");
  command
      .add_option("--vary", options.vary,
                  "key=a:b:n for n values evenly from a to b, key=v1,v2 for these, key=a:b for "
                  "values drawn by chance; keys as for bench --set; may be repeated, all "
                  "combinations are played")
      ->allow_extra_args(false);
  command
      .add_option("--samples", options.samples,
                  "how many values are drawn; more can be asked for later")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}));
  command.add_option("--seed", options.seed, "of what is drawn")->capture_default_str();
  add_set_option(command, options.overrides);
  add_allow_option(command, options.allowed);
  command
      .add_option("--method", options.methods,
                  "joining method: dmp2, dmp2a, dmp3, dmp2j (default: all)")
      ->allow_extra_args(false)
      ->delimiter(',');
}

}  // namespace

void add_sweep_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "sweep", "play many variants of a scene; taken up again where it was stopped");
  add_what(command, *options);
  add_jobs_option(command, options->jobs);
  command
      .add_option("--shard", options->shard,
                  "i/n: play the i-th (from 0) of n parts, into a file of its own")
      ->capture_default_str();
  command.add_option("--merge", options->merge, "files of all shards: put them together");
  command.add_option("-o,--out", options->out, "CSV file: a row per sample and method")->required();
  command.footer(
      "Example: seam sweep carrying --vary sequence.steps.0.until.before_end=0:1.2:61 --out "
      "joins.csv\nWhat is measured is explained in README.md; FILE.json says what was played, "
      "FILE.rows grows meanwhile.");
  command.callback([options] { sweep_or_merge(*options); });
}

}  // namespace seam
