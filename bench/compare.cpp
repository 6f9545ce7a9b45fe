#include "bench/compare.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <utility>

#include "bench/parallel.hpp"
#include "scenes/play.hpp"

namespace seam {

namespace {

constexpr double ticks_after_a_join = 50;  // that its torque jump takes, and more

struct Play {
  const Scene* scene;
  Join method;
  Recording recording;
  Recording half;  // at dt/2, at the first place alone, until the last join
  Replay replay;
  double wall = 0.0;  // [s] of the recording
};

// Nothing but the joins is measured at dt/2.
Recording half(const Scene& scene, Join method, const Recording& whole) {
  Scene until_last_join = scene;
  if (!whole.joins.empty())
    until_last_join.duration =
        std::min(scene.duration, whole.joins.back().time + ticks_after_a_join * scene.dt);
  return play_at_first_place(until_last_join, method, 0.5 * scene.dt);
}

void perform(Play& play) {
  const auto begin = std::chrono::steady_clock::now();
  play.recording = seam::play(*play.scene, play.method, play.scene->dt, &play.replay);
  play.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  play.half = half(*play.scene, play.method, play.recording);
}

std::string description(const Play& play) {
  return on_arm(play.scene->name, play.scene->arm) + " " + std::string(to_string(play.method));
}

void perform_all(std::vector<Play>& plays, int jobs, const Progress& progress) {
  std::mutex mutex;
  int done = 0;
  for_each_index(static_cast<std::int64_t>(plays.size()), jobs, [&](std::int64_t i) {
    Play& play = plays[static_cast<std::size_t>(i)];
    perform(play);
    const std::lock_guard lock(mutex);
    progress(++done, static_cast<int>(plays.size()), description(play));
  });
}

double simulated(const Play& play) {
  return play.scene->dt * play.recording.ticks() * static_cast<double>(play.scene->places());
}

// But for the recording and the replay, which others may be measured by.
Run measured(const Play& play, const Play& dmp2) {
  Run run;
  run.method = play.method;
  run.metrics = measure(play.recording, {&play.half, &dmp2.recording});
  run.real_time_factor = simulated(play) / play.wall;
  return run;
}

// dmp2 is always played: it is what the others deviate from.
std::vector<Join> with_dmp2(std::vector<Join> methods) {
  if (std::find(methods.begin(), methods.end(), Join::dmp2) == methods.end())
    methods.push_back(Join::dmp2);
  return methods;
}

}  // namespace

std::string title_on_arm(const Scene& scene) {
  return scene.arm == ideal_arm ? scene.title : scene.title + " (" + scene.arm + " arm)";
}

std::vector<Comparison> compare(const std::vector<Scene>& scenes, const std::vector<Join>& methods,
                                int jobs, const Progress& progress) {
  const std::vector<Join> played = with_dmp2(methods);
  std::vector<Play> plays;
  for (const Scene& scene : scenes)
    for (const Join method : played) plays.push_back({&scene, method, {}, {}, {}, 0.0});
  perform_all(plays, jobs, progress);

  const auto play_of = [&](const Scene& scene, Join method) {
    return std::find_if(plays.begin(), plays.end(), [&](const Play& play) {
      return play.scene == &scene && play.method == method;
    });
  };
  std::vector<Comparison> comparisons;
  for (const Scene& scene : scenes) {
    const auto dmp2 = play_of(scene, Join::dmp2);
    Comparison comparison{scene, {}};
    for (const Join method : methods)
      comparison.runs.push_back(measured(*play_of(scene, method), *dmp2));
    for (Run& run : comparison.runs) {
      const auto play = play_of(scene, run.method);
      run.recording = std::move(play->recording);
      run.replay = std::move(play->replay);
    }
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

}  // namespace seam
