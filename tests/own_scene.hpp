#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/scene.hpp"
#include "tests/temp_folder.hpp"
#include <seam/recording.hpp>

namespace seam::test {

/// One of the project's own scenes.
inline Scene own_scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return Scene::read(std::string(SEAM_SCENES) + "/" + name + ".yaml", overrides);
}

/// A scene in a folder of its own: a robot's joint "j" goes by minimum jerk from 0 to 1 rad in a second.
struct OneJoint {
  /// @param more  lines behind the scene's others
  explicit OneJoint(const std::string& urdf, const std::string& more = "") {
    folder.write("r.urdf", urdf);
    std::string demonstration = "time,j\n";
    for (int k = 0; k <= 100; ++k) {
      const double s = k / 100.0;
      demonstration += std::to_string(s) + "," +
                       std::to_string(s * s * s * (10.0 + s * (-15.0 + 6.0 * s))) + "\n";
    }
    folder.write("up.csv", demonstration);
    path = folder.write("one.yaml", R"(format: seam-scene 1
title: One joint
robot: {urdf: r.urdf}
sequence:
  start_after: 0.1
  primitives: {up: {demonstration: up.csv, kernels: 5}}
  steps: [{play: up}]
figure: j
)" + more);
  }
  Scene read(const std::vector<std::string>& overrides = {}) const {
    return Scene::read(path, overrides);
  }

  TempFolder folder;
  std::string path;
};

/// What came of a run; a failure if that was not measured.
inline double outcome(const Recording& recording, const std::string& name) {
  for (const Outcome& outcome : recording.outcomes)
    if (outcome.name == name) return outcome.value;
  ADD_FAILURE() << "no outcome " << name;
  return 0.0;
}

}  // namespace seam::test
