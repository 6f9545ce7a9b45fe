#pragma once

#include <stdexcept>
#include <string>

#include <seam/export.hpp>

namespace SEAM_API seam {

/// What every failing set-up call of seam throws: one line that names the file (or object), the
/// place in it, the value found, and what would be right, as in
/// `pa10.urdf: link "w1": mass -1 kg, must be > 0`. Nothing that runs inside a tick throws.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  /// @param place  the file, and where in it, e.g. `reach.csv:12`
  /// @param what   what is wrong and what would be right
  Error(const std::string& place, const std::string& what)
      : std::runtime_error(place + ": " + what) {}
};

}  // namespace seam
