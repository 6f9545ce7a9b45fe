#include "bench/options.hpp"

#include <algorithm>
#include <thread>

#include <CLI/CLI.hpp>

namespace seam {

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
