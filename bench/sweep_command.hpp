#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam sweep SCENE --vary key=a:b:n --out FILE.csv`: plays many variants of a scene, on all cores, and `seam sweep --merge
/// PART... --out FILE.csv`. Runs while the command line is parsed. Throws Error where anything is wrong.
void add_sweep_command(CLI::App& app);

}  // namespace seam
