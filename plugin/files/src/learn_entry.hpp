#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "yaml_reader.hpp"
#include <seam/primitive.hpp>

namespace seam {

/// A primitive learned from what the key `demonstration` names, with the settings of a map's other
/// keys.
/// @param reference  q₀ for a demonstration with an orientation; else its first sample
/// @throws Error  see read_sequence
Primitive learn_primitive(const YamlEntry& entry,
                          const std::optional<Eigen::Quaterniond>& reference);

}  // namespace seam
