#include "bench/report_command.hpp"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/page.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

struct Options {
  std::string results;
  std::string out;
};

void report(const Options& options) {
  write_page(options.results, options.out);
  if (std::filesystem::is_regular_file(options.out))
    fmt::print("{}: {:.1f} MB, for any browser\n", options.out,
               1e-6 * static_cast<double>(std::filesystem::file_size(options.out)));
}

}  // namespace

void add_report_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("report", "make one page of what a bench left in a folder");
  command.add_option("results", options->results, "folder that seam bench or seam run filled")
      ->required();
  command.add_option("-o,--out", options->out, "page (HTML) to write")->required();
  command.callback([options] { report(*options); });
}

}  // namespace seam
