#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam metrics RECORDING.csv --join T`: measures a recording of anyone's. Runs while the command line is parsed. Throws
/// Error where anything is wrong.
void add_metrics_command(CLI::App& app);

}  // namespace seam
