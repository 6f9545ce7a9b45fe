#include "bench/learn_command.hpp"

#include <cmath>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenes/own_folders.hpp"
#include <seam/error.hpp>
#include <seam/learn.hpp>
#include <seam/orientation.hpp>
#include <seam/primitive_file.hpp>

namespace seam {

namespace {

struct Options {
  std::string demonstration;
  std::string out;
  std::vector<double> reference;  // q₀ as x y z w
  double stiffness = Gains().K;
  LearnSettings learning;
  DerivativeSettings derivatives;
};

// Rotation vectors that the file has itself are taken as about the reference.
Demonstration about_reference(Demonstration demo, const Options& options) {
  const bool turns = has_orientation(demo);
  if (options.reference.empty()) {
    if (!turns) return demo;
    const Eigen::Vector4d first = first_orientation(demo).coeffs();
    throw Error(demo.source,
                fmt::format("has an orientation, needs --reference QX QY QZ QW, the same for all "
                            "primitives that are joined; its first sample: {:.9g}",
                            fmt::join(first, " ")));
  }
  const Eigen::Quaterniond q0(Eigen::Vector4d(options.reference.data()));
  if (!(std::abs(q0.norm() - 1.0) <= 1e-3))
    throw Error("--reference",
                fmt::format("quaternion of norm {:g}, must be 1 within 0.001", q0.norm()));
  if (turns) return with_rotation_vector(demo, q0.normalized(), options.derivatives);
  demo.reference_orientation = q0.normalized();
  return demo;
}

std::string time_constant(const Primitive& primitive) {
  if (primitive.kind == Kind::discrete) return fmt::format("tau {:.6g} s", primitive.tau);
  return fmt::format("tau {:.6g} s, period {:.6g} s", primitive.tau, 2.0 * M_PI * primitive.tau);
}

void print_summary(const Demonstration& demo, const Primitive& primitive, const LearnReport& report,
                   const std::string& out) {
  fmt::print("{}: {} samples of {} in {:.6g} s\n", demo.source, demo.samples(),
             fmt::join(demo.coordinates, ", "), demo.duration());
  fmt::print("{}: {}, {} kernels, {}\n", out,
             primitive.kind == Kind::discrete ? "discrete" : "rhythmic", primitive.kernels.count(),
             time_constant(primitive));
  fmt::print("forcing term: relative RMS error {:.2g}, condition {:.3g}\n", report.forcing_error,
             report.condition);
  fmt::print("reproduction: {:.2g} rad or m at most, {:.2g} RMS\n", report.error_max,
             report.error_rms);
}

void learn_file(Options options) {
  options.learning.gains = Gains::critical(options.stiffness);
  const Demonstration demo = about_reference(
      Demonstration::read(own_or_given(options.demonstration), options.derivatives), options);
  const Primitive primitive = learn(demo, options.learning);
  const LearnReport report = assess(demo, primitive);
  write_primitive(options.out, primitive);
  print_summary(demo, primitive, report, options.out);
}

template <typename Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  return names;
}

template <typename Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Value& value,
                        const std::map<std::string, Value>& choices, const std::string& what) {
  const auto set = [&value, choices, name](const std::string& choice) {
    const auto found = choices.find(choice);
    if (found == choices.end())
      throw CLI::ValidationError(name, fmt::format("\"{}\", must be one of {}", choice,
                                                   fmt::join(names_of(choices), ", ")));
    value = found->second;
  };
  return command.add_option_function<std::string>(name, set, what)->type_name("NAME");
}

void add_learning(CLI::App& command, LearnSettings& learning) {
  add_choice<Kind>(command, "--kind", learning.kind,
                   {{"discrete", Kind::discrete}, {"rhythmic", Kind::rhythmic}},
                   "discrete or rhythmic (default: discrete)");
  command.add_option("--period", learning.period, "[s] of a rhythmic movement (default: found)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--kernels", learning.kernels,
                  "number of kernels (default: 10, rhythmic 20; the most with --precision: 100)")
      ->check(CLI::Range(2, 10000));
  command
      .add_option(
          "--width", learning.width,
          "kernel width as a multiple of the kernels' distance (default: 0.75, rhythmic 1.02)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--precision", learning.precision,
                  "[rad or m] take the fewest kernels that reproduce the movement to this")
      ->check(CLI::PositiveNumber);
  add_choice<LearnMethod>(command, "--method", learning.method,
                          {{"least_squares", LearnMethod::least_squares},
                           {"recursive", LearnMethod::recursive},
                           {"locally_weighted", LearnMethod::locally_weighted}},
                          "least_squares, recursive or locally_weighted (default: least_squares)");
  command.add_option("--alpha", learning.alpha, "decay of a discrete primitive's phase")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace

void add_learn_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("learn", "learn a primitive from a demonstration");
  command
      .add_option("demonstration", options->demonstration,
                  "CSV file: time [s], then a column per coordinate [rad or m]")
      ->required();
  command.add_option("-o,--out", options->out, "primitive file (YAML) to write")->required();
  add_learning(command, options->learning);
  command.add_option("--stiffness", options->stiffness, "K; damping and goal filter are critical")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--cutoff", options->derivatives.cutoff,
                  "[Hz] of the smoothing fit that derivatives are taken from")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option(
          "--reference", options->reference,
          "QX QY QZ QW that an orientation is turned from (or rx ry rz are), the same for all "
          "that is joined")
      ->expected(4);
  command.callback([options] { learn_file(*options); });
}

}  // namespace seam
