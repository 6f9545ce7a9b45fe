#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/scene.hpp"
#include <seam/recording.hpp>

namespace seam::test {

/// One of the project's own scenes.
inline Scene own_scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return Scene::read(std::string(SEAM_SCENES) + "/" + name + ".yaml", overrides);
}

/// What came of a run; a failure if that was not measured.
inline double outcome(const Recording& recording, const std::string& name) {
  for (const Outcome& outcome : recording.outcomes)
    if (outcome.name == name) return outcome.value;
  ADD_FAILURE() << "no outcome " << name;
  return 0.0;
}

}  // namespace seam::test
