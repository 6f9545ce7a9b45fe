#include "bench/rollout_command.hpp"

#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/options.hpp"
#include "scenes/own_folders.hpp"
#include <seam/error.hpp>
#include <seam/sequence_file.hpp>
#include <seam/sequencer.hpp>
#include <seam/table.hpp>

namespace seam {

namespace {

constexpr double longest = 600.0;  // [s] for a sequence that might never finish
constexpr double most_rows = 2e6;

struct Options {
  std::string sequence;
  std::string method;
  std::string out;
  std::vector<std::string> allowed;
  double dt = 1e-3;       // [s]
  double settle = 1.0;    // [s]
  double duration = 0.0;  // [s] 0: until the last switch and `settle`
};

std::vector<std::string> columns_for(const std::vector<std::string>& coordinates) {
  std::vector<std::string> columns{"time", "switch"};
  for (const char* prefix : {"ref.", "ref_vel.", "ref_acc."})
    for (const std::string& name : coordinates) columns.push_back(prefix + name);
  return columns;
}

void append_row(const Sequencer& sequencer, double time, std::vector<double>& rows) {
  rows.push_back(time);
  rows.push_back(sequencer.running());
  const Sample& at = sequencer.sample();
  for (const Eigen::VectorXd* part : {&at.position, &at.velocity, &at.acceleration})
    rows.insert(rows.end(), part->begin(), part->end());
}

void require_rows(double time, const Options& options) {
  if (time > most_rows * options.dt)
    throw Error("--dt", fmt::format("{:g} s gives more than {:g} rows, must be larger", options.dt,
                                    most_rows));
}

// Rows at k·dt until the end, which is known when the last switch has been due.
std::vector<double> play(Sequencer& sequencer, const Options& options) {
  std::vector<double> rows;
  double end = options.duration > 0.0 ? options.duration : INFINITY;
  require_rows(options.duration, options);
  for (long k = 0;; ++k) {
    const double time = static_cast<double>(k) * options.dt;
    if (sequencer.finished() && std::isinf(end)) end = time + options.settle;
    if (time > end + 0.5 * options.dt) return rows;
    if (std::isinf(end) && time > longest)
      throw Error(options.sequence, fmt::format("primitive {} has not handed over after {:g} s, "
                                                "needs --duration",
                                                sequencer.running() + 1, longest));
    require_rows(time, options);
    append_row(sequencer, time, rows);
    sequencer.step(options.dt);
  }
}

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

void roll_out(const Options& options) {
  const Join method = join_from_name(options.method);
  const SequenceFile file =
      read_sequence(own_or_given(options.sequence), with_own_folders(options.allowed));
  Sequencer sequencer(file.sequence, method, file.start_state());
  const std::vector<double> rows = play(sequencer, options);
  Table table{columns_for(file.sequence.coordinates()), {}};
  const auto C = static_cast<Eigen::Index>(table.columns.size());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  table.values =
      Eigen::Map<const RowMajor>(rows.data(), static_cast<Eigen::Index>(rows.size()) / C, C);
  table.write(options.out);
  fmt::print("{} with {}, steps at its joins:\n", options.sequence, options.method);
  print_joins(sequencer, file.primitives);
  fmt::print("{}: {} rows every {:g} ms\n", options.out, table.values.rows(), options.dt * 1e3);
}

}  // namespace

void add_rollout_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("rollout", "play a sequence alone, without physics");
  command.add_option("sequence", options->sequence, "sequence file (YAML)")->required();
  command.add_option("--method", options->method, "joining method: dmp2, dmp2a, dmp3, dmp2j")
      ->required();
  command.add_option("--dt", options->dt, "[s] between rows")
      ->check(CLI::Number & CLI::Range(1e-6, 0.1))
      ->capture_default_str();
  command.add_option("--settle", options->settle, "[s] to go on after the last switch")
      ->check(CLI::Number & CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command
      .add_option("--duration", options->duration, "[s] of it all, whatever has happened by then")
      ->check(CLI::Number & CLI::Range(1e-6, 36000.0));
  add_allow_option(command, options->allowed);
  command.add_option("-o,--out", options->out, "recording (CSV) to write")->required();
  command.callback([options] { roll_out(*options); });
}

}  // namespace seam
