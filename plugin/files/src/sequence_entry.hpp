#pragma once

#include <functional>

#include "yaml_reader.hpp"
#include <seam/sequence_file.hpp>

namespace seam {

/// A sequence from a map with the keys of a sequence file; `format` may be left out.
/// @param check  throws Error on a primitive that will not do; it is refused where it is played
/// @throws Error  see read_sequence
SequenceFile read_sequence(const YamlEntry& entry,
                           const std::function<void(const Primitive&)>& check = nullptr);

/// Values of some coordinates by their names; NaN where there is none.
/// @throws Error  names file, line and key: one that is not among the coordinates, a value that is not a finite number
Eigen::VectorXd read_values(const YamlEntry& entry, const std::vector<std::string>& coordinates);

}  // namespace seam
