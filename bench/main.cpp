#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/commands.hpp"
#include "bench/interrupt.hpp"
#include <seam/error.hpp>

namespace {

int run(int argc, char** argv) {
  CLI::App app{"seam: movement primitives on a Bullet arm, joined without a step in torque",
               "seam"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "seam " SEAM_VERSION);
  seam::add_commands(app);

  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0) throw seam::Error("standard output", "cannot be written");
    return 0;
  } catch (const CLI::Success& shown) {
    return app.exit(shown);
  } catch (const CLI::RuntimeError& failed) {  // a check: it has said what
    return failed.get_exit_code();
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "seam: {} (see seam --help)\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "seam: {}\n", error.what());
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  seam::clear_up_when_interrupted();
  return run(argc, argv);
}
