#pragma once

#include "plugin/files/src/yaml_reader.hpp"
#include "scenes/scene.hpp"

namespace seam {

/// The keys `tool`, `liquid`, `pouring`, `camera` and `table` of a scene (see scenes/README.md). Liquid and pouring fill in what the scene has of them, and
/// give their masses and shapes to its robot.
/// @throws Error  names file, line and key
ToolSettings read_tool(const YamlEntry& entry, const Scene& scene);
void read_liquid(const YamlEntry& entry, Scene& scene);
void read_pouring(const YamlEntry& entry, Scene& scene);
Camera read_camera(const YamlEntry& entry);
Geometry read_table(const YamlEntry& entry);

}  // namespace seam
