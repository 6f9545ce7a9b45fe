#pragma once

#include <string>

#include "yaml_reader.hpp"
#include <seam/primitive.hpp>

namespace seam {

/// A primitive from a map with the keys of a primitive file; `format` may be left out.
/// @throws Error  see read_primitive
Primitive read_primitive(const YamlEntry& entry);

/// The lines of that map but for `reference`, each behind an indent.
/// @throws Error  the primitive is not valid, or a coordinate has no name
std::string primitive_entries(const Primitive& primitive, const std::string& indent);

}  // namespace seam
