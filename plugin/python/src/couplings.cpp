// Couplings, also such as are written in Python, and obstacles.
#include "plugin/python/src/couplings.hpp"

#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/parts.hpp"
#include <seam/obstacles.hpp>

namespace seam::python {

namespace {

// One that is written in Python. What it raises cannot pass through a step.
class OwnCoupling : public Coupling {
 public:
  void add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
           Eigen::VectorXd& ydd) const noexcept override {
    const py::gil_scoped_acquire in_python;
    try {
      add_own(y, yd, t, ydd);
    } catch (py::error_already_set& error) {
      error.discard_as_unraisable("Coupling.add");
    } catch (const std::exception& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
      PyErr_WriteUnraisable(nullptr);
    }
  }

 private:
  void add_own(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
               Eigen::VectorXd& ydd) const {
    const py::function own = py::get_override(static_cast<const Coupling*>(this), "add");
    if (own) ydd += Numbers{own(y, yd, t)}.vector("Coupling.add", ydd.size());
  }
};

Eigen::VectorXd acceleration(const Coupling& coupling, const Numbers& y, const Numbers& yd,
                             double t) {
  const Eigen::VectorXd at = y.vector("y");
  Eigen::VectorXd c = Eigen::VectorXd::Zero(at.size());
  coupling.add(at, yd.vector("yd", at.size()), t, c);
  return c;
}

void bind_coupling(py::module_& module) {
  Class<Coupling, OwnCoupling, std::shared_ptr<Coupling>> coupling(module, "Coupling");
  (*coupling)
      .def(py::init<>(), "To be derived from: see `add`.")
      .def("add", &acceleration,
           "C, an array (D,) [per s²]. A class of your own has a method of this name; what it "
           "raises goes to sys.unraisablehook, and C is 0 then.\n\nArgs:\n"
           "    y: (D,) [rad or m]\n    yd: (D,) [per s]\n    t: [s], of the motion's own time",
           py::arg("y"), py::arg("yd"), py::arg("t"));
}

void bind_shapes(py::module_& module) {
  Class<Steering>(module, "Steering")
      .field("strength", &Steering::strength)
      .field("sharpness", &Steering::sharpness)
      .field("reach", &Steering::reach)
      .made_of_fields();
  Class<Ball>(module, "Ball")
      .field("radius", &Ball::radius)
      .field("strength", &Ball::strength)
      .field("reach", &Ball::reach)
      .made_of_fields();
  Class<Box>(module, "Box")
      .field("size", &Box::size)
      .field("orientation", &Box::orientation)
      .field("strength", &Box::strength)
      .field("reach", &Box::reach)
      .made_of_fields();
  Class<Fading>(module, "Fading")
      .field("from_", &Fading::from)
      .field("over", &Fading::over)
      .made_of_fields();
  Class<Moving>(module, "Moving")
      .field("to", &Moving::to)
      .field("from_", &Moving::from)
      .field("over", &Moving::over)
      .made_of_fields();
}

void bind_obstacle(py::module_& module) {
  Class<ObstacleSettings> settings(module, "ObstacleSettings");
  settings.field("at", &ObstacleSettings::at)
      .field("shape", &ObstacleSettings::shape)
      .field("appears", &ObstacleSettings::appears)
      .field("vanishes", &ObstacleSettings::vanishes)
      .field("moves", &ObstacleSettings::moves)
      .made_of_fields();
  settings.def("at_speed", &ObstacleSettings::at_speed, py::arg("factor"));
  const auto point = [](const Numbers& given, const char* name) {
    return Eigen::Vector3d(given.vector(name, 3));
  };
  Class<Obstacle, Coupling, std::shared_ptr<Obstacle>>(module, "Obstacle")
      .init(
          [](const std::vector<std::string>& coordinates, const ObstacleSettings& what) {
            return std::make_shared<Obstacle>(coordinates, what);
          },
          py::arg("coordinates"), py::arg("settings"))
      .def("appear", &Obstacle::appear, py::arg("from_"), py::arg("over"))
      .def("vanish", &Obstacle::vanish, py::arg("from_"), py::arg("over"))
      .def(
          "move",
          [point](Obstacle& self, const Numbers& to, double from, double over) {
            return self.move(point(to, "to"), from, over);
          },
          py::arg("to"), py::arg("from_"), py::arg("over"))
      .def("position", &Obstacle::position, py::arg("time"))
      .def("presence", &Obstacle::presence, py::arg("time"))
      .def(
          "distance",
          [point](const Obstacle& self, const Numbers& tool, double time) {
            return self.distance(point(tool, "tool"), time);
          },
          py::arg("tool"), py::arg("time"))
      .def(
          "potential",
          [point](const Obstacle& self, const Numbers& tool, double time) {
            return self.potential(point(tool, "tool"), time);
          },
          py::arg("tool"), py::arg("time"));
}

}  // namespace

std::shared_ptr<Coupling> kept(const py::object& coupling) {
  auto* const cpp = coupling.cast<Coupling*>();
  if (!cpp) throw Error("sequencer", "a coupling is None");
  auto* const python = new py::object(coupling);
  return {cpp, [python](Coupling*) {
            const py::gil_scoped_acquire in_python;
            delete python;
          }};
}

void bind_couplings(py::module_& module) {
  bind_coupling(module);
  bind_shapes(module);
  bind_obstacle(module);
}

}  // namespace seam::python
