#pragma once

#include <map>
#include <string>
#include <string_view>

namespace seam::python {

/// What the C++ headers say of each public name, as in `Gains::K`: made by headers.py.
const std::map<std::string_view, const char*>& docstrings();

/// That of a name; empty where the headers say nothing. What Python keeps for itself has a `_` at its end there.
inline const char* doc(std::string name) {
  if (name.back() == '_') name.pop_back();
  const auto found = docstrings().find(name);
  return found == docstrings().end() ? "" : found->second;
}

}  // namespace seam::python
