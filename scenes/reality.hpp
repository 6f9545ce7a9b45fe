#pragma once

#include "plugin/files/src/yaml_reader.hpp"
#include "scenes/scene.hpp"

namespace seam {

/// The keys `actuator`, `friction`, `sensors`, `guard` and `model_error` of a scene (see scenes/README.md). What is set per joint is a
/// number for all, or a map of joints.
/// @throws Error  names file, line and key
ActuatorSettings read_actuator(const YamlEntry& entry, const RobotModel& robot);
FrictionSettings read_friction(const YamlEntry& entry, const RobotModel& robot);
SensorSettings read_sensor(const YamlEntry& entry, const RobotModel& robot);
GuardSettings read_guard(const YamlEntry& entry, const RobotModel& robot);
/// Falsifies the scene's robot as the controller takes it to be, or loads the one that is simulated.
void read_model_error(const YamlEntry& entry, Scene& scene);

}  // namespace seam
