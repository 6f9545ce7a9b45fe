#pragma once

#include "plugin/files/src/yaml_reader.hpp"
#include "scenes/scene.hpp"

namespace seam {

/// What a scene says of how its arm is not ideal, and of the controller that copes: the keys `rotor_inertia`, `friction`, `elastic`,
/// `actuator`, `sensors`, `model_error`, `known`, `control` and `guard` (see scenes/README.md). What is set per joint is a number
/// for all, or a map of joints. They are read from the file of the arm that the scene names, if any, and then from the scene
/// itself, which changes what it gives.
/// @throws Error  names file, line and key
void read_reality(const YamlEntry& scene_file, Scene& scene);

/// Where an arm of this name is looked for: NAME.yaml beside the robot's URDF.
std::string named_arm(const std::string& urdf, const std::string& name);

}  // namespace seam
