#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bench/compare.hpp"

namespace seam {

/// {"joins": [{"time", "metrics": {…}, "joint"}], "metrics": {…}}, names as in `columns`; null: not measured. The joint
/// is that of the largest torque jump.
nlohmann::ordered_json to_json(const Run& run);

/// {"seam", "bullet"}: what made the figures.
nlohmann::ordered_json versions_json(const std::string& seam_version);

}  // namespace seam
