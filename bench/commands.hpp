#pragma once

namespace CLI {
class App;
}

namespace seam {

/// All commands of the program, each in its own header; no number option of any takes NaN or infinity.
void add_commands(CLI::App& app);

}  // namespace seam
