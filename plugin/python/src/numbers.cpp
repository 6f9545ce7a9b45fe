#include "plugin/python/src/numbers.hpp"

#include <algorithm>
#include <cstring>

namespace seam::python {

namespace {

std::string shape_of(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

py::array_t<double> array_of(const Numbers& numbers, const std::string& name) {
  if (py::hasattr(numbers.given, "mask") &&
      py::module_::import("numpy.ma").attr("is_masked")(numbers.given).cast<bool>())
    throw Error(name, "has values that are masked");
  const py::array any = py::array::ensure(numbers.given);
  if (!any) PyErr_Clear();
  if (!any || !holds_numbers(any))
    throw Error(name, std::string("given as ") + Py_TYPE(numbers.given.ptr())->tp_name +
                          (any ? " of " + py::str(any.dtype()).cast<std::string>() : "") +
                          ", must be an array of numbers");
  auto array = py::array_t<double, py::array::forcecast>::ensure(any);
  if (!array) throw py::error_already_set();
  return array;
}

// The type of arrays of float64, of which numpy has one.
const py::dtype& float64() {
  static const auto* const type =
      new py::dtype(py::dtype::of<double>());  // outlives the interpreter's last call
  return *type;
}

}  // namespace

Eigen::VectorXd Numbers::vector(const std::string& name) const {
  const auto array = array_of(*this, name);
  if (array.ndim() != 1) throw Error(name, "shape " + shape_of(array) + ", must be (n,)");
  return array.cast<Eigen::VectorXd>();
}

Eigen::VectorXd Numbers::vector(const std::string& name, Eigen::Index n) const {
  const auto array = array_of(*this, name);
  if (array.ndim() != 1 || array.shape(0) != n)
    throw Error(name, "shape " + shape_of(array) + ", must be (" + std::to_string(n) + ",)");
  return array.cast<Eigen::VectorXd>();
}

Eigen::MatrixXd Numbers::matrix(const std::string& name) const {
  const auto array = array_of(*this, name);
  if (array.ndim() == 1) return array.cast<Eigen::VectorXd>();
  if (array.ndim() != 2) throw Error(name, "shape " + shape_of(array) + ", must be (n, m) or (n,)");
  return array.cast<Eigen::MatrixXd>();
}

void Numbers::copy_to(Eigen::VectorXd& values, const char* name) const {
  const auto* array = py::detail::array_proxy(given.ptr());
  const bool is_plain = reinterpret_cast<PyObject*>(Py_TYPE(given.ptr())) ==
                        reinterpret_cast<PyObject*>(py::detail::npy_api::get().PyArray_Type_);
  const bool is_ready = is_plain && array->descr == float64().ptr() && array->nd == 1 &&
                        array->dimensions[0] == values.size();
  if (!is_ready) {
    values = vector(name, values.size());
    return;
  }
  const char* at = array->data;
  for (double& value : values) {
    std::memcpy(&value, at, sizeof value);
    at += array->strides[0];
  }
}

void require_shape(const Eigen::MatrixXd& values, Eigen::Index rows, Eigen::Index cols,
                   const std::string& name) {
  const auto shape = [](Eigen::Index m, Eigen::Index n) {
    return "(" + std::to_string(m) + ", " + std::to_string(n) + ")";
  };
  if (values.rows() != rows || values.cols() != cols)
    throw Error(name,
                "shape " + shape(values.rows(), values.cols()) + ", must be " + shape(rows, cols));
}

bool holds_numbers(const py::array& array) {
  return std::string("biuf").find(array.dtype().kind()) != std::string::npos;
}

py::array new_array(const Eigen::VectorXd& values) {
  const auto& numpy = py::detail::npy_api::get();
  const py::ssize_t size = values.size();
  auto array = py::reinterpret_steal<py::array>(numpy.PyArray_NewFromDescr_(
      numpy.PyArray_Type_, float64().inc_ref().ptr(), 1, &size, nullptr, nullptr, 0, nullptr));
  if (!array) throw py::error_already_set();
  std::copy(values.begin(), values.end(), static_cast<double*>(array.mutable_data()));
  return array;
}

Eigen::Vector4d to_numbers(const Eigen::Quaterniond& orientation) {
  return orientation.coeffs();
}

Eigen::Quaterniond to_quaternion(const Numbers& numbers, const std::string& name) {
  return Eigen::Quaterniond(Eigen::Vector4d(numbers.vector(name, 4)));
}

Eigen::Isometry3d to_pose(const Numbers& numbers, const std::string& name) {
  constexpr double rounding = 1e-6;
  const Eigen::MatrixXd matrix = numbers.matrix(name);
  require_shape(matrix, 4, 4, name);
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  if (!matrix.allFinite() || !(R * R.transpose()).isIdentity(rounding) || R.determinant() < 0.0 ||
      !matrix.row(3).isApprox(Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0), rounding))
    throw Error(name, "is no pose: must be a rotation matrix and a position, with 0 0 0 1 below");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = R;
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

}  // namespace seam::python
