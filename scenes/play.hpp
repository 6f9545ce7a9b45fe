#pragma once

#include "scenes/replay.hpp"
#include "scenes/scene.hpp"
#include <seam/join.hpp>
#include <seam/recording.hpp>

namespace seam {

/// Runs a scene in a Bullet world of its own and records every tick. The same scene, method and dt
/// give the same bits, whatever else runs beside it.
/// @param dt  [s] Bullet's tick
/// @param replay  filled with what it looks like, unless null
/// @throws Error  see Robot and Controller
Recording play(const Scene& scene, Join method, double dt, Replay* replay = nullptr);

/// The same at the first of the scene's places alone: the recording is that of `play`, what came of it is not the worst of all.
Recording play_at_first_place(const Scene& scene, Join method, double dt);

}  // namespace seam
