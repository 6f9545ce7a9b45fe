#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bench/compare.hpp"

namespace seam {

/// {"joins": [{"time", "metrics": {…}}], "metrics": {…}}, names as in `columns`; null: not measured.
nlohmann::ordered_json to_json(const Run& run);

/// {"seam", "bullet"}: what made the figures.
nlohmann::ordered_json versions_json(const std::string& seam_version);

}  // namespace seam
