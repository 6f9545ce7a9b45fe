#include "bench/micro/pair.hpp"

#include <algorithm>
#include <ctime>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

namespace seam::micro {

namespace {

/// The value below which a share of all lies.
double quantile(double share, std::vector<double> values) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

double now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double duration(clockid_t clock, const std::function<void()>& work) {
  const double begin = now(clock);
  work();
  return now(clock) - begin;
}

constexpr double fast =
    0.05;  // of the pairs; the very shortest time is as often one that the clock missed part of

void alternate(benchmark::State& state, const Pair& pair, double bar) {
  std::vector<double> work, beside, ratio;
  for (auto _ : state) {
    pair.before();
    work.push_back(pair.work() / pair.items);
    beside.push_back(pair.beside() / pair.items);
    ratio.push_back(work.back() / beside.back());
    state.SetIterationTime(work.back());
  }
  state.counters["time"] = quantile(0.5, work);
  state.counters["beside"] = quantile(0.5, beside);
  state.counters["ratio"] = quantile(0.5, ratio);
  state.counters["fast_ratio"] = quantile(fast, work) / quantile(fast, beside);
  state.counters["bar"] = bar;
}

}  // namespace

Timed timed(std::function<void()> work) {
  return [work = std::move(work)] { return duration(CLOCK_THREAD_CPUTIME_ID, work); };
}

Timed timed_on_the_wall(std::function<void()> work) {
  return [work = std::move(work)] { return duration(CLOCK_MONOTONIC, work); };
}

void add_pair(const std::string& name, double bar, int pairs, std::function<Pair()> make) {
  const auto run = [bar, make = std::move(make)](benchmark::State& state) {
    alternate(state, make(), bar);
  };
  benchmark::RegisterBenchmark(name.c_str(), run)->UseManualTime()->Iterations(pairs);
}

}  // namespace seam::micro
