#include "bench/commands.hpp"

#include "bench/bench_command.hpp"
#include "bench/check_command.hpp"
#include "bench/experiment_command.hpp"
#include "bench/learn_command.hpp"
#include "bench/metrics_command.hpp"
#include "bench/options.hpp"
#include "bench/render_command.hpp"
#include "bench/report_command.hpp"
#include "bench/rollout_command.hpp"
#include "bench/sweep_command.hpp"

namespace seam {

void add_commands(CLI::App& app) {
  add_bench_command(app);
  add_run_command(app);
  add_learn_command(app);
  add_rollout_command(app);
  add_sweep_command(app);
  add_experiment_command(app);
  add_render_command(app);
  add_metrics_command(app);
  add_check_command(app);
  add_report_command(app);
  require_numbers(app);
}

}  // namespace seam
