#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam render RESULTS/SCENE/METHOD -o PICTURE`: a picture or a movie of a run, or of several side by side. Runs while the
/// command line is parsed. Throws Error where anything is wrong, and writes nothing then.
void add_render_command(CLI::App& app);

}  // namespace seam
