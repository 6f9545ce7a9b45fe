#pragma once

#include <string>
#include <vector>

#include "yaml_reader.hpp"
#include <seam/obstacles.hpp>

namespace seam {

/// An obstacle from an entry of a sequence's list `couplings`.
/// @param coordinates  of the sequence
/// @throws Error  see read_sequence
ObstacleSettings read_obstacle(const YamlEntry& entry, const std::vector<std::string>& coordinates);

/// A list `couplings`, which comes back bit for bit; none where there are none.
/// @param coordinates  of the sequence
/// @throws Error  one that would be refused
std::string couplings_text(const std::vector<ObstacleSettings>& obstacles,
                           const std::vector<std::string>& coordinates);

}  // namespace seam
