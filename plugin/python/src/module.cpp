#include "plugin/python/src/parts.hpp"
#include <seam/error.hpp>

PYBIND11_MODULE(_seam, module) {
  namespace py = pybind11;
  // Classes are known, shown and pickled by the package that offers them.
  module.attr("__name__") = "seam";
  module.attr("__version__") = SEAM_VERSION;
  py::register_exception<seam::Error>(module, "Error", PyExc_ValueError).attr("__doc__") =
      "What seam refuses, in one line: the file or object, the place in it, the value, and what "
      "would be right.";
  using namespace seam::python;
  bind_primitives(module);
  bind_learning(module);
  bind_recordings(module);
  bind_couplings(module);
  bind_sequences(module);
  bind_robots(module);
  bind_dynamics(module);
  bind_kinematics(module);
  bind_control(module);
  bind_scenes(module);
}
