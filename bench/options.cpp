#include "bench/options.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace seam {

namespace {

std::string not_finite(const std::string& text) {
  double value = 0.0;
  const bool is_number = CLI::detail::lexical_cast(text, value);
  return is_number && std::isfinite(value) ? "" : fmt::format("{}, must be a finite number", text);
}

std::string not_whole(const std::string& text) {
  std::int64_t value = 0;
  std::uint64_t positive = 0;
  const bool is_number =
      CLI::detail::lexical_cast(text, value) || CLI::detail::lexical_cast(text, positive);
  return is_number ? "" : fmt::format("{}, must be a whole number", text);
}

// In front of the option's own checks, which NaN passes. It changes nothing.
void check_first(CLI::Option& option, std::string (*refusal)(const std::string&)) {
  option.transform(CLI::Validator([refusal](std::string& text) { return refusal(text); }, ""));
}

}  // namespace

void require_numbers(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options()) {
      const std::string type = option->get_type_name();
      if (type.rfind("FLOAT", 0) == 0) check_first(*option, not_finite);
      if (type.rfind("INT", 0) == 0 || type.rfind("UINT", 0) == 0) check_first(*option, not_whole);
    }
}

int all_cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void add_jobs_option(CLI::App& command, int& jobs) {
  command.add_option("--jobs", jobs, "threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_set_option(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option("--set", overrides,
                  "key=value: an entry of the scene file set anew, e.g. actuator.lag=0.002 or "
                  "sequence.steps.0.until={after: 0.6}; may be repeated")
      ->allow_extra_args(false);
}

void add_allow_option(CLI::App& command, std::vector<std::string>& folders) {
  command
      .add_option(
          "--allow", folders,
          "a folder of which files may be named, beside that of the file which names them and "
          "what is below it; may be repeated")
      ->allow_extra_args(false)
      ->check(CLI::ExistingDirectory);
}

}  // namespace seam
