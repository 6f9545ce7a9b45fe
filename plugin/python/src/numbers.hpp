#pragma once

#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <seam/error.hpp>
#include <seam/per_joint.hpp>

namespace seam::python {

namespace py = pybind11;

/// A file's path: a str, or anything that has one (pathlib).
struct Path {
  std::string value;

  operator const std::string&() const { return value; }  // NOLINT(google-explicit-constructor)
};

/// Whatever numpy makes an array of numbers of: an array, a list, a column of pandas.
struct Numbers {
  py::object given;

  /// @throws Error  NAME: not numbers, or another shape
  Eigen::VectorXd vector(const std::string& name) const;
  Eigen::VectorXd vector(const std::string& name, Eigen::Index n) const;
  /// Of one dimension: a column.
  Eigen::MatrixXd matrix(const std::string& name) const;
  /// Puts n numbers where they are wanted, without a copy in between where they are an array of float64.
  void copy_to(Eigen::VectorXd& values, const char* name) const;
};

/// @throws Error  NAME: another shape
void require_shape(const Eigen::MatrixXd& values, Eigen::Index rows, Eigen::Index cols,
                   const std::string& name);
/// Whether an array holds numbers, and not text, objects or complex ones.
bool holds_numbers(const py::array& array);

/// A new array of float64, quicker than by casts: of one dimension.
py::array new_array(const Eigen::VectorXd& values);

/// The values of Eigen as an array that cannot be written to: a copy.
template <typename Values>
py::array read_only(const Values& values) {
  py::array array = py::cast(values, py::return_value_policy::copy);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same without a copy, for as long as the owner of the values cannot change their size.
template <typename Values>
py::array view_of(const Values& values, py::handle owner) {
  using Scalar = typename Values::Scalar;
  constexpr auto size = static_cast<py::ssize_t>(sizeof(Scalar));
  const bool is_vector = Values::IsVectorAtCompileTime;
  std::vector<py::ssize_t> shape{values.rows()}, strides{size};
  if (!is_vector) shape.push_back(values.cols()), strides.push_back(size * values.rows());
  py::array array(py::dtype::of<Scalar>(), shape, strides, values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// x y z w of a quaternion, and a pose as a matrix of 4 × 4.
Eigen::Vector4d to_numbers(const Eigen::Quaterniond& orientation);
Eigen::Quaterniond to_quaternion(const Numbers& numbers, const std::string& name);
Eigen::Isometry3d to_pose(const Numbers& numbers, const std::string& name);

}  // namespace seam::python

namespace pybind11::detail {

template <>
struct type_caster<seam::python::Numbers> {
  PYBIND11_TYPE_CASTER(seam::python::Numbers, const_name("ArrayLike"));
  bool load(handle from, bool) {
    value.given = reinterpret_borrow<object>(from);
    return !from.is_none();
  }
};

template <>
struct type_caster<seam::python::Path> {
  PYBIND11_TYPE_CASTER(seam::python::Path, const_name("os.PathLike"));
  bool load(handle from, bool) {
    object path = reinterpret_steal<object>(PyOS_FSPath(from.ptr()));
    if (path && isinstance<bytes>(path))
      path = reinterpret_steal<object>(PyUnicode_DecodeFSDefault(PyBytes_AsString(path.ptr())));
    const object encoded =
        path ? reinterpret_steal<object>(PyUnicode_EncodeFSDefault(path.ptr())) : object();
    if (!encoded) {
      PyErr_Clear();
      return false;
    }
    value.value = encoded.cast<std::string>();
    return true;
  }
};

template <>
struct type_caster<Eigen::Quaterniond> {
  PYBIND11_TYPE_CASTER(Eigen::Quaterniond, const_name("numpy.ndarray[numpy.float64[4, 1]]"));
  bool load(handle from, bool) {
    value = seam::python::to_quaternion({reinterpret_borrow<object>(from)}, "quaternion x y z w");
    return true;
  }
  static handle cast(const Eigen::Quaterniond& from, return_value_policy, handle) {
    return pybind11::cast(seam::python::to_numbers(from)).release();
  }
};

template <>
struct type_caster<Eigen::Isometry3d> {
  PYBIND11_TYPE_CASTER(Eigen::Isometry3d, const_name("numpy.ndarray[numpy.float64[4, 4]]"));
  bool load(handle from, bool) {
    value = seam::python::to_pose({reinterpret_borrow<object>(from)}, "pose");
    return true;
  }
  static handle cast(const Eigen::Isometry3d& from, return_value_policy, handle) {
    return pybind11::cast(Eigen::Matrix4d(from.matrix())).release();
  }
};

template <>
struct type_caster<seam::PerJoint> {
  PYBIND11_TYPE_CASTER(seam::PerJoint,
                       const_name("Union[float, numpy.ndarray[numpy.float64[m, 1]]]"));
  type_caster() : value(0.0) {}
  bool load(handle from, bool) {
    const array given = array::ensure(from);
    if (!given) PyErr_Clear();
    if (given && given.ndim() == 0 && seam::python::holds_numbers(given))
      value = seam::PerJoint(given.attr("item")().cast<double>());
    else
      value = seam::PerJoint(
          seam::python::Numbers{reinterpret_borrow<object>(from)}.vector("value per joint"));
    return true;
  }
  static handle cast(const seam::PerJoint& from, return_value_policy, handle) {
    if (from.size() == 1) return pybind11::cast(from(0)).release();
    return seam::python::read_only(from.each(from.size())).release();
  }
};

}  // namespace pybind11::detail
