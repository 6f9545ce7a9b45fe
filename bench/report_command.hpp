#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam report DIR -o report.html`: what a bench left behind as one page. Runs while the command line is parsed.
/// Throws Error where anything is wrong, and writes nothing then.
void add_report_command(CLI::App& app);

}  // namespace seam
