#pragma once

#include <string>

namespace seam {

/// A line on a terminal that says how far long work is; it goes when the work is done. Elsewhere nothing is printed.
void show_progress(int done, int total, const std::string& what);

}  // namespace seam
