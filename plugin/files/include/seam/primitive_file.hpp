#pragma once

#include <string>

#include <seam/export.hpp>
#include <seam/primitive.hpp>

namespace SEAM_API seam {

/// Reads a primitive from a YAML file of the format `seam-primitive 1` or `2`, which adds the key
/// `reference`. What write_primitive has written comes back bit for bit. All keys but `reference`
/// must be there, and no others:
///
///     format: seam-primitive 2
///     reference: [0, 0, 0, 1]            # optional, unit quaternion x y z w: the reference
///                                        # orientation of the coordinates rx ry rz
///     kind: discrete                     # or rhythmic
///     coordinates: ["x", "y"]            # D names
///     tau: 1.2                           # [s] duration, or period/2π
///     alpha: 2                           # decay of the discrete phase
///     gains: {K: 200, D: 28.28, H: 14.14}
///     goal: [0.3, 0.1]                   # D [rad or m]
///     start: {position: [0, 0], velocity: [0, 0], acceleration: [0, 0]}   # D each, SI units
///     kernels: {centers: [1, 0.5, 0.1], widths: [0.4, 0.3, 0.3]}          # M each
///     weights:                           # M rows, one number per coordinate
///       - [1.5, 20]
///       - [-30, 4]
///       - [7, -1]
/// @throws Error  names file, line and key: unreadable, not YAML, a newer format, a missing, extra
///                or repeated key, a value that is not a finite number or out of range, a wrong
///                size
Primitive read_primitive(const std::string& path);

/// Writes a primitive with 17 significant digits, of format 1 where it has no reference orientation,
/// so that an older seam can read it. The file appears whole or not at all.
/// @throws Error  the primitive is not valid, a coordinate has no name, or the file cannot be
///                written
void write_primitive(const std::string& path, const Primitive& primitive);

}  // namespace seam
