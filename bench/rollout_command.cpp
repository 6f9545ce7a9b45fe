#include "bench/rollout_command.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/options.hpp"
#include "scenes/own_folders.hpp"
#include <seam/error.hpp>
#include <seam/rollout.hpp>
#include <seam/sequence_file.hpp>

namespace seam {

namespace {

struct Options {
  std::string sequence;
  std::string method;
  std::string out;
  std::vector<std::string> allowed;
  RolloutSettings settings;
};

double largest(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  return (after - before).cwiseAbs().maxCoeff();
}

void print_joins(const Sequencer& sequencer, const std::vector<std::string>& names) {
  fmt::print("{:>10}  {:20}  {:>20}  {:>16}\n", "join [s]", "to", "acceleration [/s2]",
             "jerk [/s3]");
  for (int i = 0; i < sequencer.joins(); ++i) {
    const JoinEvent& join = sequencer.join(i);
    const bool settles = i > 0 && join.primitive == sequencer.join(i - 1).primitive;
    fmt::print("{:10.4f}  {:20}  {:20.3g}  {:16.3g}\n", join.time,
               settles ? "rest at the goal" : names[static_cast<std::size_t>(join.primitive)],
               largest(join.acceleration_before, join.acceleration_after),
               largest(join.jerk_before, join.jerk_after));
  }
}

// What the wishes of each primitive cost, of each coordinate.
void print_prices(const Sequencer& sequencer, const std::vector<std::string>& names) {
  bool first = true;
  for (int i = 0; i < sequencer.joins(); ++i) {
    const JoinEvent& join = sequencer.join(i);
    if (join.price.acceleration.isZero(0.0)) continue;
    if (first)
      fmt::print("{:>10}  {:20}  {:>20}  {:>16}  {:>20}\n", "wishes [s]", "of", "coordinate",
                 "deviation", "acceleration [/s2]");
    first = false;
    for (std::size_t d = 0; d < sequencer.coordinates().size(); ++d) {
      const auto row = static_cast<Eigen::Index>(d);
      fmt::print("{:10.4f}  {:20}  {:>20}  {:16.3g}  {:20.3g}\n", join.time,
                 names[static_cast<std::size_t>(join.primitive)], sequencer.coordinates()[d],
                 join.price.deviation(row), join.price.acceleration(row));
    }
  }
}

void roll_out(const Options& options) {
  const Join method = join_from_name(options.method);
  const SequenceFile file =
      read_sequence(own_or_given(options.sequence), with_own_folders(options.allowed));
  Sequencer sequencer(file.sequence, method, file.start_state());
  add_obstacles(file.couplings, sequencer);
  Recording recording;
  try {
    recording = rollout(sequencer, options.settings);
  } catch (const Error& error) {
    throw Error(options.sequence, error.what());
  }
  recording.write(options.out);
  fmt::print("{} with {}, steps at its joins:\n", options.sequence, options.method);
  print_joins(sequencer, file.primitives);
  print_prices(sequencer, file.primitives);
  fmt::print("{}: {} rows every {:g} ms\n", options.out, recording.ticks(),
             options.settings.dt * 1e3);
}

}  // namespace

void add_rollout_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("rollout", "play a sequence alone, without physics");
  command.add_option("sequence", options->sequence, "sequence file (YAML)")->required();
  command.add_option("--method", options->method, "joining method: dmp2, dmp2a, dmp3, dmp2j")
      ->required();
  command.add_option("--dt", options->settings.dt, "[s] between rows")
      ->check(CLI::Number & CLI::Range(1e-6, 0.1))
      ->capture_default_str();
  command.add_option("--settle", options->settings.settle, "[s] to go on after the last switch")
      ->check(CLI::Number & CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command
      .add_option("--duration", options->settings.duration,
                  "[s] of it all, whatever has happened by then")
      ->check(CLI::Number & CLI::Range(1e-6, 36000.0));
  add_allow_option(command, options->allowed);
  command.add_option("-o,--out", options->out, "recording (CSV) to write")->required();
  command.callback([options] { roll_out(*options); });
}

}  // namespace seam
