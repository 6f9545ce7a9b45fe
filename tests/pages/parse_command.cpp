// Usage: parse_command ARGUMENT...
// Parses a command line of seam and does nothing of it. Exit 0, or what CLI11 says of it.

#include <CLI/CLI.hpp>

#include "bench/commands.hpp"

int main(int argc, char** argv) {
  CLI::App app;
  app.require_subcommand(1);
  app.set_version_flag("--version", SEAM_VERSION);
  seam::add_commands(app);
  app.parse_complete_callback([] { throw CLI::Success(); });  // before the command is carried out
  CLI11_PARSE(app, argc, argv);
}
