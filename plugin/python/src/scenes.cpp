// The benchmark scenes, headless.
#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/parts.hpp"
#include "scenes/own_folders.hpp"
#include "scenes/play.hpp"
#include "scenes/scene.hpp"

namespace seam::python {

namespace {

void bind_events(py::module_& module) {
  py::class_<Event> event(module, "Event",
                          "Something that happens to a running sequence at a time.");
  py::enum_<Event::What>(event, "What")
      .value("goal", Event::What::goal)
      .value("tau", Event::What::tau)
      .value("amplitude", Event::What::amplitude)
      .value("rate", Event::What::rate)
      .value("hand_over", Event::What::hand_over)
      .value("pass_", Event::What::pass)
      .value("hit", Event::What::hit);
  event
      .def_readonly("at", &Event::at,
                    "[s] since the run began; takes effect at the first tick then or later.")
      .def_readonly("what", &Event::what, "What happens.")
      .def_property_readonly(
          "goal", [](const Event& self) { return read_only(self.goal); },
          "(D,) [rad or m]; NaN where a coordinate's goal stays. Of a wish: the position.")
      .def_property_readonly(
          "velocity", [](const Event& self) { return read_only(self.velocity); },
          "(D,) of a wish [rad/s or m/s]; NaN where it is free, or empty.")
      .def_readonly("when", &Event::when, "[s] since the run began: a wish's moment.")
      .def_readonly("which", &Event::which, "Index of the wish that is moved; -1: one more.")
      .def_readonly("value", &Event::value, "tau [s], amplitude, or rate.")
      .def_readonly("over", &Event::over, "[s] in which the rate changes.")
      .def("happen", &Event::happen, py::arg("sequencer"),
           "Makes it happen now. False where the sequencer refuses it (an amplitude of a discrete "
           "primitive, say).");
}

}  // namespace

void bind_scenes(py::module_& module) {
  bind_events(module);
  py::class_<Scene>(module, "Scene",
                    "A scene file, read and learned: all that a run needs but the joining method.")
      .def_static(
          "read",
          [](const Path& scene, const std::vector<std::string>& overrides,
             const std::vector<std::string>& allowed) {
            return Scene::read(scene_file(scene), overrides, with_own_folders(allowed));
          },
          py::arg("scene"), py::arg("overrides") = std::vector<std::string>{},
          py::arg("allowed") = std::vector<std::string>{}, py::call_guard<py::gil_scoped_release>(),
          "Reads a scene: the name of one of seam's own, or a file.\n\nArgs:\n"
          "    overrides: entries that are set anew, as in \"speed=1.2\" or "
          "\"control.observer=60\"\n"
          "    allowed: folders of which files may be named beside the scene's own and seam's\n\n"
          "Raises:\n    Error: names file, line and key")
      .def_readonly("name", &Scene::name, "The file's name without its ending.")
      .def_readonly("title", &Scene::title, "One line.")
      .def_readonly("urdf", &Scene::urdf, "Path of the robot's URDF.")
      .def_readonly(
          "arm", &Scene::arm,
          "How the simulated arm differs from an ideal one: `ideal`, or the name of its file.")
      .def_property_readonly(
          "robot", [](const Scene& self) { return RobotModel(self.robot); },
          "A copy of the model that the controller takes the robot for.")
      .def_property_readonly(
          "start", [](const Scene& self) { return read_only(self.start); },
          "(n,) joint positions [rad or m], at rest.")
      .def_property_readonly(
          "tool", [](const Scene& self) { return self.tool; },
          "Settings of the tool, in task space, a copy; else None.")
      .def_property_readonly(
          "sequence", [](const Scene& self) { return Sequence(self.sequence); }, "A copy.")
      .def_property_readonly(
          "primitive_names",
          [](const Scene& self) { return py::tuple(py::cast(self.primitive_names)); },
          "A name for each step of the sequence.")
      .def_property_readonly(
          "settings", [](const Scene& self) { return ArmControllerSettings(self.controller()); },
          "Settings of the controller, as ArmController takes them.")
      .def_property_readonly(
          "events", [](const Scene& self) { return py::tuple(py::cast(self.events)); },
          "What happens on the way, sorted by time.")
      .def_readonly("method", &Scene::method, "The joining method that the file asks for, or None.")
      .def_readonly("dt", &Scene::dt, "[s] Bullet's tick.")
      .def_readonly("duration", &Scene::duration, "[s] of a run.")
      .def_readonly("speed", &Scene::speed,
                    "Factor by which all is faster than the file's times say.")
      .def_readonly("seed", &Scene::seed, "Of whatever is drawn by chance.")
      .def("__repr__", [](const Scene& self) {
        return "<Scene " + on_arm(self.name, self.arm) + ": " + self.title + ">";
      });

  module.def(
      "_play",
      [](const Scene& scene, const Named<Join>& method, double dt) {
        py::gil_scoped_release others_go_on;
        return play(scene, method.value, dt);
      },
      py::arg("scene"), py::arg("method"), py::arg("dt"));
  module.def("_scene_files", [] { return scene_files({}); });
  module.def("_own_folder", &own_folder);
  module.def("_set_own_folder", &set_own_folder, py::arg("folder"));
}

}  // namespace seam::python
