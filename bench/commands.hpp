#pragma once

namespace CLI {
class App;
}

namespace seam {

/// All commands of the program, each in its own header.
void add_commands(CLI::App& app);

}  // namespace seam
