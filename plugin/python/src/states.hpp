#pragma once

#include <cmath>
#include <string>
#include <variant>

#include "plugin/python/src/bind.hpp"
#include <seam/error.hpp>
#include <seam/join.hpp>
#include <seam/robot_model.hpp>

namespace seam::python {

/// A state to continue from: a Sample, or positions at rest.
struct Start {
  std::variant<Sample, Numbers> given;

  /// @throws Error  not D finite values each
  Sample of(int dimensions, const std::string& name) const {
    Sample sample;
    if (const auto* numbers = std::get_if<Numbers>(&given))
      sample = Sample::at_rest(numbers->vector(name, dimensions));
    else
      sample = std::get<Sample>(given);
    for (const Eigen::VectorXd* part :
         {&sample.position, &sample.velocity, &sample.acceleration, &sample.jerk}) {
      if (part->size() != dimensions)
        throw Error(name, "has " + std::to_string(part->size()) + " coordinates, must have " +
                              std::to_string(dimensions));
      if (!part->allFinite()) throw Error(name, "is not finite");
    }
    return sample;
  }
};

/// A model as it is, unless it was changed to what cannot be simulated.
/// @throws Error  names the joint or link and the value
const RobotModel& sound(const RobotModel& model);

/// @throws Error  a value is not finite
inline Eigen::VectorXd finite(Eigen::VectorXd values, const std::string& name) {
  if (!values.allFinite()) throw Error(name, "is not finite");
  return values;
}

/// @throws Error  it is negative or not finite
inline double require_step(double dt) {
  if (!(dt >= 0.0 && std::isfinite(dt))) throw Error("dt", std::to_string(dt) + " s, must be >= 0");
  return dt;
}

/// @throws Error  it is not > 0, or not finite
inline double require_tick(double dt) {
  if (!(dt > 0.0 && std::isfinite(dt))) throw Error("dt", std::to_string(dt) + " s, must be > 0");
  return dt;
}

}  // namespace seam::python

namespace pybind11::detail {

template <>
struct type_caster<seam::python::Start> {
  PYBIND11_TYPE_CASTER(seam::python::Start, const_name("Union[") + make_caster<seam::Sample>::name +
                                                const_name(", ArrayLike]"));
  bool load(handle from, bool) {
    if (from.is_none()) return false;
    make_caster<seam::Sample> sample;
    if (sample.load(from, false))
      value.given = cast_op<seam::Sample&>(sample);
    else
      value.given = seam::python::Numbers{reinterpret_borrow<object>(from)};
    return true;
  }
};

}  // namespace pybind11::detail
