// Cost of learning 1000 samples of 7 coordinates, once the derivatives are there, and of the smoothing fit that gives them.

#include <benchmark/benchmark.h>

#include "bench/micro/benchmarks.hpp"
#include "bench/micro/pair.hpp"
#include <seam/seam.hpp>

namespace seam::micro {

namespace {

constexpr int samples = 1000;
constexpr int dimensions = 7;
constexpr double limit = 0.3e-3;  // [s]

Demonstration demonstration() {
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0);
  Eigen::MatrixXd position(samples, dimensions);
  std::vector<std::string> names;
  for (int d = 0; d < dimensions; ++d) {
    names.push_back("q" + std::to_string(d));
    position.col(d) = (2.0 * M_PI * time.array() + d).sin();
  }
  return Demonstration::from_positions(names, time, position);
}

Timed learning(Kind kind) {
  LearnSettings settings;
  settings.kind = kind;
  settings.period = kind == Kind::rhythmic ? 1.0 : 0.0;
  return timed(
      [demo = demonstration(), settings] { benchmark::DoNotOptimize(learn(demo, settings)); });
}

}  // namespace

void add_learn_benchmarks() {
  for (const auto& [name, kind] :
       {std::pair{"discrete", Kind::discrete}, {"rhythmic", Kind::rhythmic}})
    add_pair(std::string("learning 1000 samples × 7, ") + name + " / 0.3 ms", 1.0, 1000,
             [kind = kind] {
               return Pair{learning(kind), [] { return limit; }};
             });
  add_pair("their derivatives by smoothing / learning them", no_bar, 100, [] {
    return Pair{timed([] { benchmark::DoNotOptimize(demonstration()); }), learning(Kind::discrete)};
  });
}

}  // namespace seam::micro
