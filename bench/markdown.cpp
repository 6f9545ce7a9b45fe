#include "bench/markdown.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace seam {

namespace {

// Characters that a UTF-8 text takes on the screen.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

}  // namespace

std::string shown(double value, const std::string& format) {
  if (!std::isfinite(value)) return "n/a";
  const std::string text = fmt::format(fmt::runtime(format), value);
  const bool minus_zero = text[0] == '-' && text.find_first_of("123456789") == std::string::npos;
  return minus_zero ? text.substr(1) : text;
}

std::string markdown(const Rows& rows, std::size_t texts) {
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += "|";
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string padding(widths[c] - width(rows[r][c]), ' ');
      text += c < texts ? " " + rows[r][c] + padding + " |" : " " + padding + rows[r][c] + " |";
    }
    text += '\n';
    if (r > 0) continue;
    text += "|";
    for (std::size_t c = 0; c < widths.size(); ++c)
      text += std::string(widths[c] + (c < texts ? 2 : 1), '-') + (c < texts ? "|" : ":|");
    text += '\n';
  }
  return text;
}

}  // namespace seam
