#pragma once

#include <seam/robot_model.hpp>

namespace seam::micro {

/// The PA-10 with one mesh on each body to collide as, in the place of its boxes and cylinders: a rounded cylinder of 336 vertices.
/// That is about as many as bullet3's kuka_iiwa has on its hulls, and the last but two body comes as near to the last. The
/// mesh's file is there until the program ends.
const RobotModel& mesh_arm();

}  // namespace seam::micro
