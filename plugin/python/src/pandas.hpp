#pragma once

#include <pybind11/pybind11.h>

namespace seam::python {

inline constexpr const char* to_pandas_doc =
    "The same as a frame of pandas, a column for each column of its CSV file, with time [s] as the "
    "index.\n\n"
    "Raises:\n    ImportError: pandas is not installed";

/// Of a recording or a demonstration.
inline pybind11::object to_pandas(const pybind11::object& self) {
  return pybind11::module_::import("seam._recordings").attr("to_pandas")(self);
}

}  // namespace seam::python
