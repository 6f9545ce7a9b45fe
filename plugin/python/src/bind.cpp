#include "plugin/python/src/bind.hpp"

namespace seam::python {

std::string attribute_name(py::handle type, const std::string& attribute) {
  return type.attr("__qualname__").cast<std::string>() + "." + attribute;
}

py::object member(py::handle enumeration, py::handle name) {
  const py::dict members = enumeration.attr("__members__");
  if (members.contains(name)) return members[name];
  std::string names;
  for (const auto& [known, value] : members)
    names += (names.empty() ? "" : ", ") + known.cast<std::string>();
  throw Error(enumeration.attr("__qualname__").cast<std::string>(),
              "\"" + name.cast<std::string>() + "\", must be one of " + names);
}

}  // namespace seam::python
