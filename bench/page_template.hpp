#pragma once

#include <string_view>

namespace seam {

/// The report page without its data, as `bench/page` builds it.
extern const std::string_view page_template;

}  // namespace seam
