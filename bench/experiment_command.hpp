#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam experiment [NAME...]`: questions to a scene, each answered by a table and a plot. Runs while the command line is
/// parsed. Throws Error where anything is wrong.
void add_experiment_command(CLI::App& app);

}  // namespace seam
