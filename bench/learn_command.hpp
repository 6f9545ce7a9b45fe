#pragma once

namespace CLI {
class App;
}

namespace seam {

/// `seam learn DEMO.csv -o PRIMITIVE.yaml`: data to primitive, with a summary of the fit on the
/// terminal. Runs while the command line is parsed. Throws Error where anything is wrong, and
/// writes nothing then.
void add_learn_command(CLI::App& app);

}  // namespace seam
