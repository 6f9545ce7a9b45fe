#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam bench [SCENE...]`: plays scenes with every method and compares, also with baselines (exit code 1 where a figure
/// differs). Runs while the command line is parsed. Throws Error where anything is wrong.
void add_bench_command(CLI::App& app);

/// `seam run SCENE`: the same for one scene and one method.
void add_run_command(CLI::App& app);

}  // namespace seam
