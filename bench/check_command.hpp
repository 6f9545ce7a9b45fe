#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam check ROBOT.urdf`: looks a robot over, on one page. Runs while the command line is parsed. Throws Error where
/// the URDF is refused, CLI::RuntimeError(1) where a check failed.
void add_check_command(CLI::App& app);

}  // namespace seam
