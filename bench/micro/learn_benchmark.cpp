// Cost of learning 1000 samples of 7 coordinates, once the derivatives are there, and of the smoothing fit that gives them.

#include <benchmark/benchmark.h>

#include <seam/seam.hpp>

namespace {

constexpr int samples = 1000;
constexpr int dimensions = 7;

seam::Demonstration demonstration() {
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0);
  Eigen::MatrixXd position(samples, dimensions);
  std::vector<std::string> names;
  for (int d = 0; d < dimensions; ++d) {
    names.push_back("q" + std::to_string(d));
    position.col(d) = (2.0 * M_PI * time.array() + d).sin();
  }
  return seam::Demonstration::from_positions(names, time, position);
}

void learn(benchmark::State& state, seam::Kind kind) {
  const seam::Demonstration demo = demonstration();
  seam::LearnSettings settings;
  settings.kind = kind;
  settings.period = kind == seam::Kind::rhythmic ? 1.0 : 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(seam::learn(demo, settings));
}

void derivatives(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(demonstration());
}

}  // namespace

BENCHMARK_CAPTURE(learn, discrete, seam::Kind::discrete)
    ->Repetitions(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(learn, rhythmic, seam::Kind::rhythmic)
    ->Repetitions(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(derivatives)->Repetitions(15)->Unit(benchmark::kMillisecond);
