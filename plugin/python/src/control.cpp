// An arm's controller: (q, qd) in, torque out.
#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/parts.hpp"
#include "plugin/python/src/states.hpp"
#include <seam/arm_controller.hpp>

namespace seam::python {

namespace {

// A controller, and room for the state that comes in.
struct Arm {
  ArmController control;
  Eigen::VectorXd q, qd;

  const Eigen::VectorXd& tick(double dt, const Numbers& q_now, const Numbers& qd_now) {
    require_tick(dt);
    q_now.copy_to(q, "q");
    qd_now.copy_to(qd, "qd");
    return control.tick(dt, q, qd);
  }
};

void bind_settings(py::module_& module) {
  Class<ArmControllerSettings>(module, "ArmControllerSettings")
      .field("law", &ArmControllerSettings::law)
      .field("tool", &ArmControllerSettings::tool)
      .field("actuator", &ArmControllerSettings::actuator)
      .field("sensor", &ArmControllerSettings::sensor)
      .field("guard", &ArmControllerSettings::guard)
      .made_of_fields();
}

void bind_controller(py::module_& module) {
  using Tick = ArmController::Tick;
  using Status = ArmController::Status;
  Class<Arm> arm(module, "ArmController", "ArmController");
  Enum<Status>(*arm, "Status", "ArmController::Status")
      .value("following", Status::following)
      .value("bridging", Status::bridging)
      .value("stopped", Status::stopped);
  Class<Tick>(*arm, "Tick", "ArmController::Tick")
      .field("time", &Tick::time)
      .field("running", &Tick::running)
      .field("sequence", &Tick::sequence)
      .field("reference", &Tick::reference)
      .field("tool_error", &Tick::tool_error)
      .field("q", &Tick::q)
      .field("qd", &Tick::qd)
      .field("torque", &Tick::torque)
      .made_of_fields();
  const auto inside = py::return_value_policy::reference_internal;
  arm.init(
         [](const RobotModel& model, const Sequence& sequence, const JoinChoice& join,
            const ArmControllerSettings& settings, const std::optional<Numbers>& q,
            const std::optional<Numbers>& qd) {
           const int n = model.dof();
           if (!q) throw py::type_error("ArmController: needs q, where the joints are now");
           const Eigen::VectorXd at = q->vector("q", n);
           const Eigen::VectorXd moving = qd ? qd->vector("qd", n) : Eigen::VectorXd::Zero(n);
           return Arm{ArmController(sound(model), sequence, join.value, settings, at, moving), at,
                      moving};
         },
         py::arg("model"), py::arg("sequence"), py::arg("join") = "dmp3",
         py::arg_v("settings", ArmControllerSettings{}, "ArmControllerSettings()"),
         py::arg("q") = py::none(), py::arg("qd") = py::none())
      .def(
          "set_gravity",
          [](Arm& self, const Numbers& gravity) {
            self.control.set_gravity(
                finite(gravity.vector("gravity_in_base", 3), "gravity_in_base"));
          },
          py::arg("gravity_in_base"))
      .def(
          "tick",
          [](Arm& self, double dt, const Numbers& q, const Numbers& qd) {
            return new_array(self.tick(dt, q, qd));
          },
          "Advances the sequence by dt, and gives the torque that is to act from now until dt "
          "later.\n\nArgs:\n"
          "    dt: [s] > 0, from this tick to the next\n"
          "    q: (n,) [rad or m] where the joints are; NaN where that is not known\n"
          "    qd: (n,) [rad/s or m/s] how they move\n\n"
          "Returns:\n    (n,) [N·m or N] what the actuator delivers to the joints until the next "
          "tick; a new array\n\n"
          "Raises:\n    Error: q or qd has another shape or are no numbers, dt is not > 0",
          py::arg("dt"), py::arg("q"), py::arg("qd"))
      .def(
          "reinitialise",
          [](Arm& self, const Numbers& q, const Numbers& qd) {
            return self.control.reinitialise(q.vector("q", self.control.dof()),
                                             qd.vector("qd", self.control.dof()));
          },
          py::arg("q"), py::arg("qd"))
      .property("dof", [](const Arm& self) { return self.control.dof(); })
      .property("model", [](const Arm& self) { return RobotModel(self.control.model()); })
      .property("finished", [](const Arm& self) { return self.control.finished(); })
      .property("status", [](const Arm& self) { return self.control.status(); })
      .property("incident", [](const Arm& self) { return Incident(self.control.incident()); })
      .def("what_happened", [](const Arm& self) { return self.control.what_happened(); })
      .property("last_tick", [](const Arm& self) { return Tick(self.control.last_tick()); })
      .property("limited", [](const Arm& self) { return self.control.limited(); });
  (*arm).def_property_readonly(
      "sequencer",
      py::cpp_function([](Arm& self) -> Sequencer& { return self.control.sequencer(); }, inside),
      doc("ArmController::sequencer"));
}

}  // namespace

void bind_control(py::module_& module) {
  bind_settings(module);
  bind_controller(module);
}

}  // namespace seam::python
