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

}  // namespace seam
