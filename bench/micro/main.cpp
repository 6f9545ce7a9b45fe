// seam_micro: what seam's hot paths cost, each beside something bare in the same run.

#include <cstdio>
#include <fstream>
#include <thread>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/markdown.hpp"
#include "bench/micro/benchmarks.hpp"
#include "bench/micro/pair.hpp"
#include <seam/whole_file.hpp>

namespace seam::micro {

namespace {

std::string shown_time(double seconds) {
  if (seconds < 1e-6) return shown(seconds * 1e9, "{:.0f} ns");
  if (seconds < 1e-3) return shown(seconds * 1e6, "{:.3g} µs");
  return shown(seconds * 1e3, "{:.3g} ms");
}

/// Shows the benchmarks as they end and keeps a line of each for the table.
class Reporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) add(run);
  }

  const Rows& rows() const { return rows_; }
  int missed() const { return missed_; }

 private:
  void add(const Run& run) {
    const auto counter = [&](const char* name) { return run.counters.at(name).value; };
    const double bar = counter("bar");
    const bool met = bar == no_bar || counter("ratio") <= bar;
    if (!met) ++missed_;
    rows_.push_back({run.run_name.function_name, shown_time(counter("time")),
                     shown_time(counter("beside")), shown(counter("ratio"), "{:.2f}"),
                     shown(counter("fast_ratio"), "{:.2f}"),
                     bar == no_bar ? "" : shown(bar, "{:.1f}"), met ? "" : "missed"});
  }

  Rows rows_ = {{"what / beside what", "time", "beside", "ratio", "at best", "bar", ""}};
  int missed_ = 0;
};

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "an unknown processor";
}

std::string report(const Reporter& reporter) {
  return fmt::format("{}\nMeasured on {}, {} cores.\n", markdown(reporter.rows(), 1), processor(),
                     std::thread::hardware_concurrency());
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);  // takes its own options out
  CLI::App app{
      "seam_micro: what seam's hot paths cost, each beside something bare in the same run"};
  bool strict = false;
  std::string out;
  app.add_flag("--strict", strict, "exit code 1 if a bar is missed");
  app.add_option("--out", out, "file for the table (Markdown)");
  app.footer("Google Benchmark's options are taken too, e.g. --benchmark_filter=REGEX.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& shown) {
    return app.exit(shown);
  }
  add_step_benchmarks();
  add_tick_benchmarks();
  add_world_benchmarks();
  add_learn_benchmarks();
  add_jobs_benchmarks();
  Reporter reporter;
  if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) return 2;  // it has said why
  fmt::print("\n{}", report(reporter));
  if (!out.empty()) write_whole(out, report(reporter));
  return strict && reporter.missed() > 0 ? 1 : 0;
}

}  // namespace

}  // namespace seam::micro

int main(int argc, char** argv) {
  try {
    return seam::micro::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "seam_micro: {}\n", error.what());
    return 2;
  }
}
