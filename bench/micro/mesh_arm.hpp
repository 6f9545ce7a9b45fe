#pragma once

#include <seam/robot_model.hpp>

namespace seam::micro {

/// The PA-10 with one mesh on each body to collide as, in the place of its boxes and cylinders: an ellipsoid of 342 vertices, as many
/// as an arm's meshes of a CAD program have on their hulls. Its files are there until the program ends.
const RobotModel& mesh_arm();

}  // namespace seam::micro
