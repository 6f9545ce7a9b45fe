// From demonstrations to primitives.
#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/parts.hpp"
#include <seam/learn.hpp>
#include <seam/period.hpp>
#include <seam/recursive_learner.hpp>

namespace seam::python {

namespace {

// Settings of their own, changed by what is given beside them.
LearnSettings with(const LearnSettings& settings, const py::kwargs& changes) {
  if (changes.size() == 0) return settings;
  LearnSettings changed = settings;
  const py::object view = py::cast(&changed, py::return_value_policy::reference);
  for (const auto& [name, value] : changes) {
    if (!py::type::of<LearnSettings>().attr("_fields").contains(name))
      throw py::type_error("learn: LearnSettings has no " + name.cast<std::string>());
    py::setattr(view, name, value);
  }
  return changed;
}

}  // namespace

void bind_learning(py::module_& module) {
  Enum<LearnMethod>(module, "LearnMethod", "LearnMethod")
      .value("least_squares", LearnMethod::least_squares)
      .value("recursive", LearnMethod::recursive)
      .value("locally_weighted", LearnMethod::locally_weighted);
  Class<LearnSettings>(module, "LearnSettings")
      .field("kind", &LearnSettings::kind)
      .field("kernels", &LearnSettings::kernels)
      .field("width", &LearnSettings::width)
      .field("alpha", &LearnSettings::alpha)
      .field("period", &LearnSettings::period)
      .field("method", &LearnSettings::method)
      .field("precision", &LearnSettings::precision)
      .field("gains", &LearnSettings::gains)
      .made_of_fields();
  Class<LearnReport>(module, "LearnReport")
      .field("forcing_error", &LearnReport::forcing_error)
      .field("condition", &LearnReport::condition)
      .field("error_max", &LearnReport::error_max)
      .field("error_rms", &LearnReport::error_rms)
      .made_of_fields();
  module.def(
      "learn",
      [](const Demonstration& demo, const LearnSettings& settings, const py::kwargs& changes) {
        const LearnSettings changed = with(settings, changes);
        py::gil_scoped_release others_go_on;
        return learn(demo, changed);
      },
      (std::string(doc("learn")) + "\n\nIn Python the settings' attributes can be given by name, "
                                   "too: learn(demo, kind=\"rhythmic\", kernels=20).")
          .c_str(),
      py::arg("demo"), py::arg_v("settings", LearnSettings{}, "LearnSettings()"));
  def(
      module, "assess",
      [](const Demonstration& demo, const Primitive& primitive) {
        const Primitive as_it_is = primitive;  // others may change theirs meanwhile
        py::gil_scoped_release others_go_on;
        return assess(demo, as_it_is);
      },
      py::arg("demo"), py::arg("primitive"));
  def(module, "find_period", &find_period, py::arg("demo"),
      py::call_guard<py::gil_scoped_release>());
  def(
      module, "find_centre",
      [](const Demonstration& demo, double period) {
        demo.validate();
        return find_centre(demo, period);
      },
      py::arg("demo"), py::arg("period"));

  Class<RecursiveLearner> learner(module, "RecursiveLearner");
  learner
      .init(
          [](const std::vector<std::string>& coordinates, const Numbers& goal, double duration,
             const LearnSettings& settings, double lambda) {
            return RecursiveLearner(coordinates, goal.vector("goal"), duration, settings, lambda);
          },
          py::arg("coordinates"), py::arg("goal"), py::arg("duration"),
          py::arg_v("settings", LearnSettings{}, "LearnSettings()"), py::arg("lambda_") = 1e9)
      .def(
          "add",
          [](RecursiveLearner& self, double time, const Numbers& position, const Numbers& velocity,
             const Numbers& acceleration) {
            return self.add(time, position.vector("position"), velocity.vector("velocity"),
                            acceleration.vector("acceleration"));
          },
          py::arg("time"), py::arg("position"), py::arg("velocity"), py::arg("acceleration"))
      .property("samples", &RecursiveLearner::samples)
      .property("primitive",
                [](const RecursiveLearner& self) { return Primitive(self.primitive()); });
}

}  // namespace seam::python
