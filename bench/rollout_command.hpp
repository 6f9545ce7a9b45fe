#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam rollout SEQUENCE.yaml --method M -o OUT.csv`: primitives alone, without physics, and what
/// each join left on the terminal. Runs while the command line is parsed. Throws Error where
/// anything is wrong, and writes nothing then.
void add_rollout_command(CLI::App& app);

}  // namespace seam
