#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include <seam/export.hpp>

namespace SEAM_API seam {

/// What every failing set-up call of seam throws: one line that names the file (or object), the
/// place in it, the value found, and what would be right, as in
/// `pa10.urdf: link "w1": mass -1 kg, must be > 0`. Nothing that runs inside a tick throws.
class Error : public std::runtime_error {
 public:
  /// @param line  the message; control characters in it become blanks
  explicit Error(const std::string& line) : std::runtime_error(in_one_line(line)) {}
  /// @param place  the file, and where in it, e.g. `reach.csv:12`
  /// @param what   what is wrong and what would be right
  Error(const std::string& place, const std::string& what) : Error(place + ": " + what) {}

 private:
  // Names that come from files may hold line breaks and worse.
  static std::string in_one_line(std::string text) {
    const auto is_control = [](unsigned char c) { return c < 0x20; };
    std::replace_if(text.begin(), text.end(), is_control, ' ');
    return text;
  }
};

}  // namespace seam
