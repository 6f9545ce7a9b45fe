#include "plugin/python/src/bind.hpp"

namespace seam::python {

std::string attribute_name(py::handle type, const std::string& attribute) {
  return type.attr("__qualname__").cast<std::string>() + "." + attribute;
}

namespace {

long number_of(py::handle value) {
  return py::int_(py::reinterpret_borrow<py::object>(value)).cast<long>();
}

py::object name_of(py::handle value) {
  const py::dict members = py::type::of(value).attr("__members__");
  for (const auto& [name, known] : members)
    if (number_of(known) == number_of(value)) return py::reinterpret_borrow<py::object>(name);
  return py::none();
}

bool is_same(const py::object& self, const py::object& other) {
  if (py::isinstance<py::str>(other)) return name_of(self).equal(other);
  return py::type::of(self).is(py::type::of(other)) && number_of(self) == number_of(other);
}

}  // namespace

void give_names(py::object enumeration) {
  py::delattr(enumeration, "__init__");
  const auto method = [&](const char* name, auto function) {
    enumeration.attr(name) = py::cpp_function(function, py::name(name), py::is_method(enumeration));
  };
  method("__eq__", is_same);
  method("__ne__",
         [](const py::object& self, const py::object& other) { return !is_same(self, other); });
  method("__hash__", [](const py::object& self) { return py::hash(name_of(self)); });
}

py::object value_of(py::handle enumeration, const py::object& value) {
  if (py::isinstance<py::str>(value)) return member(enumeration, value);
  const py::dict members = enumeration.attr("__members__");
  for (const auto& [name, known] : members)
    if (known.is(value) || (py::isinstance<py::int_>(value) &&
                            py::int_(py::reinterpret_borrow<py::object>(known)).equal(value)))
      return py::reinterpret_borrow<py::object>(known);
  throw Error(enumeration.attr("__qualname__").cast<std::string>(),
              py::repr(value).cast<std::string>() + ", is none of its values");
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
