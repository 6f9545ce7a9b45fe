#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "plugin/python/src/docstrings.hpp"
#include "plugin/python/src/numbers.hpp"
#include <seam/join.hpp>

namespace seam::python {

/// An enumeration's value, or its name.
template <typename E>
struct Named {
  E value;
};

/// A joining method: its name, a Join or JoinSettings.
struct JoinChoice {
  JoinSettings value;
};

/// An array, with the type that it has in C++ for the signature.
template <typename Values>
struct ArrayOf {
  py::array value;
};
/// Likewise a tuple.
template <typename Item>
struct TupleOf {
  py::tuple value;
};

/// What an attribute of a class is called in messages.
std::string attribute_name(py::handle type, const std::string& attribute);
/// Lets an enumeration's values be compared with their names, and be made of names and numbers that there are.
void give_names(py::object enumeration);
/// That of an enumeration by its name or number.
/// @throws Error  no such one (lists those there are)
py::object value_of(py::handle enumeration, const py::object& value);
/// That of an enumeration by its name.
/// @throws Error  no such one (lists those there are)
py::object member(py::handle enumeration, py::handle name);
/// A function of the module, with the docstring of its C++ name.
template <typename F, typename... Extra>
void def(py::module_& module, const char* name, F&& f, const Extra&... extra) {
  module.def(name, std::forward<F>(f), doc(name), extra...);
}

}  // namespace seam::python

namespace pybind11::detail {

template <typename E>
struct type_caster<seam::python::Named<E>> {
  PYBIND11_TYPE_CASTER(seam::python::Named<E>,
                       const_name("Union[") + make_caster<E>::name + const_name(", str]"));
  bool load(handle from, bool) {
    if (isinstance<str>(from)) {
      value.value = seam::python::member(type::of<E>(), from).template cast<E>();
      return true;
    }
    make_caster<E> caster;
    if (!caster.load(from, false)) return false;
    value.value = cast_op<E&>(caster);
    return true;
  }
};

template <>
struct type_caster<seam::python::JoinChoice> {
  PYBIND11_TYPE_CASTER(seam::python::JoinChoice,
                       const_name("Union[") + make_caster<seam::Join>::name + const_name(", ") +
                           make_caster<seam::JoinSettings>::name + const_name(", str]"));
  bool load(handle from, bool) {
    make_caster<seam::Join> method;
    make_caster<seam::JoinSettings> settings;
    if (isinstance<str>(from))
      value.value = seam::join_from_name(from.cast<std::string>());
    else if (method.load(from, false))
      value.value = cast_op<seam::Join&>(method);
    else if (settings.load(from, false))
      value.value = cast_op<seam::JoinSettings&>(settings);
    else
      return false;
    return true;
  }
};

template <typename Values>
struct type_caster<seam::python::ArrayOf<Values>> {
  static constexpr auto name = make_caster<Values>::name;
  static handle cast(const seam::python::ArrayOf<Values>& from, return_value_policy, handle) {
    return handle(from.value).inc_ref();
  }
};

template <typename Item>
struct type_caster<seam::python::TupleOf<Item>> {
  static constexpr auto name =
      const_name("Tuple[") + make_caster<Item>::name + const_name(", ...]");
  static handle cast(const seam::python::TupleOf<Item>& from, return_value_policy, handle) {
    return handle(from.value).inc_ref();
  }
};

}  // namespace pybind11::detail

namespace seam::python {

/// Binds an enumeration, whose names can be given instead of its values.
template <typename E>
class Enum {
 public:
  Enum(py::handle scope, const char* name, const std::string& cpp_name)
      : cpp_name_(cpp_name), enum_(scope, name, doc(cpp_name)) {
    give_names(enum_);
    enum_.def(py::init([](const py::object& value) {
                return value_of(py::type::of<E>(), value).template cast<E>();
              }),
              py::arg("value"));
  }
  Enum& value(const char* name, E value) {
    enum_.value(name, value, doc(cpp_name_ + "::" + name));
    return *this;
  }

 private:
  std::string cpp_name_;
  py::enum_<E> enum_;
};

template <typename T>
struct is_vector : std::false_type {};
template <typename T>
struct is_vector<std::vector<T>> : std::true_type {};
template <typename T>
inline constexpr bool is_eigen =
    std::is_base_of_v<Eigen::EigenBase<T>, T> && !std::is_same_v<T, Eigen::Quaterniond>;

/// An attribute's value from what was given for it. `name` is for messages.
template <typename T>
void assign(T& to, py::handle from, const std::string& name) {
  if constexpr (is_eigen<T>) {
    const Numbers numbers{py::reinterpret_borrow<py::object>(from)};
    if constexpr (T::IsVectorAtCompileTime) {
      using Scalar = typename T::Scalar;
      const Eigen::VectorXd values = T::SizeAtCompileTime == Eigen::Dynamic
                                         ? numbers.vector(name)
                                         : numbers.vector(name, T::SizeAtCompileTime);
      to = values.cast<Scalar>();
    } else {
      const Eigen::MatrixXd values = numbers.matrix(name);
      if constexpr (T::SizeAtCompileTime != Eigen::Dynamic)
        require_shape(values, to.rows(), to.cols(), name);
      to = values;
    }
  } else {
    try {
      if constexpr (std::is_enum_v<T>)
        to = from.cast<Named<T>>().value;
      else
        to = from.cast<T>();
    } catch (const py::cast_error&) {
      throw py::type_error(name + " cannot be " + py::repr(from).cast<std::string>() + " (" +
                           Py_TYPE(from.ptr())->tp_name + ")");
    }
  }
}

/// Binds a class, with the headers' comments as docstrings. A plain struct is made of its fields by `made_of_fields`.
template <typename T, typename... Options>
class Class {
 public:
  Class(py::handle scope, const char* name, const std::string& cpp_name)
      : cpp_name_(cpp_name), class_(scope, name, doc(cpp_name)) {
    fields().clear();
  }
  Class(py::handle scope, const char* name) : Class(scope, name, name) {}

  py::class_<T, Options...>& operator*() { return class_; }

  /// A method. Its docstring is that of the C++ name, and what is added for Python's.
  template <typename F, typename... Extra>
  Class& def(const char* name, F&& f, const Extra&... extra) {
    return def_as(name, name, std::forward<F>(f), extra...);
  }
  /// A method that C++ calls otherwise.
  template <typename F, typename... Extra>
  Class& def_as(const char* name, const char* cpp, F&& f, const Extra&... extra) {
    class_.def(name, std::forward<F>(f), doc(cpp_name_ + "::" + cpp), extra...);
    return *this;
  }
  template <typename F, typename... Extra>
  Class& def_static(const char* name, F&& f, const Extra&... extra) {
    class_.def_static(name, std::forward<F>(f), doc(cpp_name_ + "::" + name), extra...);
    return *this;
  }
  /// From keywords or in the order of the arguments.
  template <typename F, typename... Extra>
  Class& init(F&& make, const Extra&... extra) {
    const std::string base = cpp_name_.substr(cpp_name_.rfind(':') + 1);
    class_.def(py::init(std::forward<F>(make)), doc(cpp_name_ + "::" + base), extra...);
    return *this;
  }
  /// What C++ has as a function without arguments.
  template <typename F>
  Class& property(const char* name, F&& get) {
    class_.def_property_readonly(name, py::cpp_function(std::forward<F>(get)),
                                 doc(cpp_name_ + "::" + name));
    return *this;
  }

  /// A member that can be read and set. Arrays are read as copies which cannot be written to, lists as tuples.
  template <typename M>
  Class& field(const char* name, M T::*member) {
    remember(name, member);
    class_.def_property(
        name, getter(member), py::cpp_function([member, name](py::handle self, py::handle value) {
          assign(self.cast<T&>().*member, value, attribute_name(py::type::of(self), name));
        }),
        doc(cpp_name_ + "::" + name));
    return *this;
  }
  /// One that is set where the object is made, and not after.
  template <typename M>
  Class& fixed(const char* name, M T::*member) {
    remember(name, member);
    class_.def_property_readonly(name, getter(member), doc(cpp_name_ + "::" + name));
    return *this;
  }
  /// The same, read by a function of the object.
  template <typename M, typename F>
  Class& fixed(const char* name, M T::*member, F&& get) {
    remember(name, member);
    class_.def_property_readonly(name, py::cpp_function(std::forward<F>(get)),
                                 doc(cpp_name_ + "::" + name));
    return *this;
  }
  /// The same, set by a function, too.
  template <typename F>
  Class& fixed_by(const char* name, std::function<void(T&, py::handle)> set, F&& get) {
    fields().push_back({name, std::move(set)});
    class_.def_property_readonly(name, py::cpp_function(std::forward<F>(get)),
                                 doc(cpp_name_ + "::" + name));
    return *this;
  }

  /// Makes it from its fields, in their order or by name; copies and pickles it.
  Class& made_of_fields() {
    show_fields();
    return made_of_many_fields();
  }
  /// The same where there are too many to be shown.
  Class& made_of_many_fields() {
    class_.def(
        py::init([](const py::args& args, const py::kwargs& kwargs) {
          return made(py::type::of<T>(), args, kwargs);
        }),
        "From the attributes, in their order or by name; what is not given has its default.");
    py::list names;
    for (const Field& field : fields()) names.append(field.name);
    class_.attr("_fields") = py::tuple(names);
    class_.def(py::pickle(
        [](py::handle self) {
          py::dict state;
          for (const Field& field : fields())
            state[field.name.c_str()] = self.attr(field.name.c_str());
          return state;
        },
        [](const py::dict& state) {
          return made(py::type::of<T>(), py::tuple(), py::reinterpret_borrow<py::kwargs>(state));
        }));
    return *this;
  }

 private:
  struct Field {
    std::string name;
    std::function<void(T&, py::handle)> set;
  };
  static std::vector<Field>& fields() {
    static std::vector<Field> list;
    return list;
  }
  static T made(const py::type& type, const py::args& args, const py::kwargs& kwargs) {
    const std::string name = type.attr("__qualname__").template cast<std::string>();
    if (args.size() > fields().size())
      throw py::type_error(name + " has " + std::to_string(fields().size()) + " attributes, " +
                           std::to_string(args.size()) + " given");
    T value = T();
    for (std::size_t i = 0; i < args.size(); ++i) {
      if (kwargs.contains(fields()[i].name.c_str()))
        throw py::type_error(name + ": " + fields()[i].name + " given twice");
      fields()[i].set(value, args[i]);
    }
    for (const auto& [key, given] : kwargs) {
      const auto wanted = key.template cast<std::string>();
      const auto found = std::find_if(fields().begin(), fields().end(),
                                      [&](const Field& field) { return field.name == wanted; });
      if (found == fields().end())
        throw py::type_error(name + " has no " + wanted + ", but " + names());
      found->set(value, given);
    }
    return value;
  }
  static std::string names() {
    std::string text;
    for (const Field& field : fields()) text += (text.empty() ? "" : ", ") + field.name;
    return text;
  }
  static std::string shown(const py::object& value) {
    constexpr py::ssize_t few = 10;
    if (py::isinstance<py::array>(value) && py::reinterpret_borrow<py::array>(value).size() > few)
      return "<array " + py::str(value.attr("shape")).template cast<std::string>() + ">";
    return py::repr(value).template cast<std::string>();
  }
  void show_fields() {
    class_.def("__repr__", [](py::handle self) {
      std::string text;
      for (const Field& field : fields())
        text +=
            (text.empty() ? "" : ", ") + field.name + "=" + shown(self.attr(field.name.c_str()));
      return py::type::of(self).attr("__qualname__").template cast<std::string>() + "(" + text +
             ")";
    });
  }
  template <typename M>
  void remember(const char* name, M T::*member) {
    const std::string full = cpp_name_.substr(cpp_name_.rfind(':') + 1) + "." + name;
    fields().push_back({name, [member, full](T& object, py::handle value) {
                          assign(object.*member, value, full);
                        }});
  }
  template <typename M>
  static py::cpp_function getter(M T::*member) {
    if constexpr (is_eigen<M>) {
      return py::cpp_function(
          [member](const T& object) -> ArrayOf<M> { return {read_only(object.*member)}; });
    } else if constexpr (is_vector<M>::value) {
      return py::cpp_function([member](const T& object) -> TupleOf<typename M::value_type> {
        return {py::tuple(py::cast(object.*member, py::return_value_policy::copy))};
      });
    } else if constexpr (std::is_class_v<M> && py::detail::is_pyobject<M>::value == false &&
                         std::is_base_of_v<py::detail::type_caster_generic,
                                           py::detail::make_caster<M>>) {
      return py::cpp_function([member](T& object) -> M& { return object.*member; },
                              py::return_value_policy::reference_internal);
    } else {
      return py::cpp_function([member](const T& object) -> M { return object.*member; });
    }
  }

  std::string cpp_name_;
  py::class_<T, Options...> class_;
};

}  // namespace seam::python
