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

struct Play {
  const Scene* scene;
  Join method;
  double dt;
  bool whole;  // filmed, at all places; else the recording is all that is wanted
  Recording recording;
  Replay replay;
  double wall = 0.0;  // [s]
};

void perform(Play& play) {
  const auto begin = std::chrono::steady_clock::now();
  play.recording = play.whole ? seam::play(*play.scene, play.method, play.dt, &play.replay)
                              : play_at_first_place(*play.scene, play.method, play.dt);
  play.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string description(const Play& play) {
  return on_arm(play.scene->name, play.scene->arm) + " " + std::string(to_string(play.method)) +
         ", dt " + std::to_string(play.dt * 1e3) + " ms";
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
  return play.dt * play.recording.ticks() * static_cast<double>(play.scene->places());
}

// But for the recording and the replay, which others may be measured by.
Run measured(const Play& full, const Recording* half, const Play& dmp2) {
  Run run;
  run.method = full.method;
  run.metrics = measure(full.recording, {half, &dmp2.recording});
  run.real_time_factor = simulated(full) / full.wall;
  return run;
}

// What drives with a lag, and torques in steps, make of a jump does not follow the tick.
bool has_order(const Scene& scene) {
  return scene.arm == ideal_arm;
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
    for (const Join method : played) {
      plays.push_back({&scene, method, scene.dt, true, {}, {}, 0.0});
      if (has_order(scene)) plays.push_back({&scene, method, 0.5 * scene.dt, false, {}, {}, 0.0});
    }
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
    for (const Join method : methods) {
      const auto full = play_of(scene, method);
      const Recording* half = has_order(scene) ? &(full + 1)->recording : nullptr;
      comparison.runs.push_back(measured(*full, half, *dmp2));
    }
    for (Run& run : comparison.runs) {
      const auto full = play_of(scene, run.method);
      run.recording = std::move(full->recording);
      run.replay = std::move(full->replay);
    }
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

}  // namespace seam
