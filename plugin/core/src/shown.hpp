#pragma once

#include <sstream>
#include <string>

namespace seam {

/// A number as a message shows it, whatever its size.
inline std::string shown(double value, int digits = 6) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

}  // namespace seam
