#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include <seam/coupling.hpp>

namespace seam::python {

/// A coupling that C++ shares: with it lives what it is in Python, whose own `add` is called.
std::shared_ptr<Coupling> kept(const pybind11::object& coupling);

}  // namespace seam::python
