#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace seam {

/// Text of parts that streams take, numbers as C writes them.
template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  (out << ... << parts);
  return out.str();
}

}  // namespace seam
