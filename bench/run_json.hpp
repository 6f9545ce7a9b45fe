#pragma once

#include <nlohmann/json.hpp>

#include "bench/compare.hpp"

namespace seam {

/// {"joins": [{"time", "metrics": {…}}], "metrics": {…}}, names as in `columns`; null: not measured.
nlohmann::ordered_json to_json(const Run& run);

}  // namespace seam
