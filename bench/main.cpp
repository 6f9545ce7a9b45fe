#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/bench_command.hpp"
#include "bench/experiment_command.hpp"
#include "bench/learn_command.hpp"
#include "bench/metrics_command.hpp"
#include "bench/render_command.hpp"
#include "bench/report_command.hpp"
#include "bench/rollout_command.hpp"
#include "bench/sweep_command.hpp"
#include <seam/error.hpp>

namespace {

int run(int argc, char** argv) {
  CLI::App app{"seam: movement primitives on a Bullet arm, joined without a step in torque"};
  app.require_subcommand(1);
  app.set_version_flag("--version", SEAM_VERSION);
  seam::add_bench_command(app);
  seam::add_run_command(app);
  seam::add_learn_command(app);
  seam::add_rollout_command(app);
  seam::add_sweep_command(app);
  seam::add_experiment_command(app);
  seam::add_render_command(app);
  seam::add_metrics_command(app);
  seam::add_report_command(app);

  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0) throw seam::Error("standard output", "cannot be written");
    return 0;
  } catch (const CLI::Success& shown) {
    return app.exit(shown);
  } catch (const CLI::RuntimeError& failed) {  // a check: it has said what
    return failed.get_exit_code();
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
