#pragma once

#include <string>
#include <vector>

namespace seam {

using Rows = std::vector<std::vector<std::string>>;

/// A number in a format of fmt; `n/a` if it is not finite.
std::string shown(double value, const std::string& format);

/// A Markdown table, the first row its heading, aligned for reading on a terminal; the first `texts` columns to the left.
std::string markdown(const Rows& rows, std::size_t texts);

}  // namespace seam
