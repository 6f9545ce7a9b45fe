#pragma once

#include <string>

#include <tinyxml2.h>

#include "urdf_document.hpp"

namespace seam {

/// Stands for a limit that the URDF does not give; urdfdom reads no infinity.
constexpr const char* unlimited_text = "1.7976931348623157e+308";

/// Empty where there is no such element or attribute.
std::string attribute(const tinyxml2::XMLElement* element, const char* name);

/// Changes what urdfdom would refuse though it can be simulated, with a warning for each change: a robot without a name,
/// materials that are named twice or say nothing, vectors of too many numbers, shapes that URDF lacks (a capsule goes
/// to urdfdom as a cylinder, and into the document's lists), an inertia without products, limits that are missing, joints
/// with more than one degree of freedom (made fixed). What seam does not read goes without a word.
/// @throws Error  a value other than a file name contains %, which urdfdom would take for a format
void mend_urdf(tinyxml2::XMLElement& robot, const std::string& path, UrdfDocument& document);

}  // namespace seam
