#pragma once

#include <pybind11/pybind11.h>

namespace seam::python {

// What the module is made of: each after what its signatures name.
void bind_primitives(pybind11::module_& module);
void bind_learning(pybind11::module_& module);
void bind_recordings(pybind11::module_& module);
void bind_couplings(pybind11::module_& module);
void bind_sequences(pybind11::module_& module);
void bind_robots(pybind11::module_& module);
void bind_dynamics(pybind11::module_& module);
void bind_kinematics(pybind11::module_& module);
void bind_control(pybind11::module_& module);
void bind_scenes(pybind11::module_& module);

}  // namespace seam::python
