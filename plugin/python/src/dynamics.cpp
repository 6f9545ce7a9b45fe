// Inverse dynamics, and the parts of a controller one by one.
#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/parts.hpp"
#include "plugin/python/src/states.hpp"
#include <seam/actuator.hpp>
#include <seam/computed_torque.hpp>
#include <seam/fading_offset.hpp>
#include <seam/guard.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/sensor.hpp>

namespace seam::python {

namespace {

// A part and the number of joints that it was made for.
template <typename Part>
struct Sized {
  Part part;
  Eigen::Index n;
};

void bind_inverse_dynamics(py::module_& module) {
  Class<InverseDynamics> dynamics(module, "InverseDynamics");
  dynamics
      .init([](const RobotModel& model) { return InverseDynamics(sound(model)); }, py::arg("model"))
      .property("dof", &InverseDynamics::dof)
      .def(
          "set_gravity",
          [](InverseDynamics& self, const Numbers& gravity) {
            self.set_gravity(finite(gravity.vector("gravity_in_base", 3), "gravity_in_base"));
          },
          py::arg("gravity_in_base"))
      .def(
          "torque",
          [](const InverseDynamics& self, const Numbers& q, const Numbers& qd, const Numbers& qdd) {
            const Eigen::Index n = self.dof();
            Eigen::VectorXd torque(n);
            self.torque(q.vector("q", n), qd.vector("qd", n), qdd.vector("qdd", n), torque);
            return torque;
          },
          py::arg("q"), py::arg("qd"), py::arg("qdd"));
}

void bind_law(py::module_& module) {
  Class<ControlSettings> settings(module, "ControlSettings");
  Enum<ControlSettings::Reference>(*settings, "Reference", "ControlSettings::Reference")
      .value("matched", ControlSettings::Reference::matched)
      .value("plain", ControlSettings::Reference::plain);
  settings.field("Kp", &ControlSettings::Kp)
      .field("Kd", &ControlSettings::Kd)
      .field("reference", &ControlSettings::reference)
      .field("friction_share", &ControlSettings::friction_share)
      .field("friction_velocity", &ControlSettings::friction_velocity)
      .field("observer", &ControlSettings::observer)
      .field("most_correction", &ControlSettings::most_correction)
      .made_of_fields();
  Class<TickGains> gains(module, "TickGains");
  gains
      .init([](double Kp, double Kd, double dt) { return TickGains(Kp, Kd, require_tick(dt)); },
            py::arg("Kp_in_time"), py::arg("Kd_in_time"), py::arg("dt"))
      .property("Kp", [](const TickGains& self) { return self.Kp; })
      .property("Kd", [](const TickGains& self) { return self.Kd; });

  Class<DisturbanceObserver> observer(module, "DisturbanceObserver");
  observer
      .init([](double bandwidth,
               const Numbers& most) { return DisturbanceObserver(bandwidth, most.vector("most")); },
            py::arg("bandwidth"), py::arg("most"))
      .property("observes", &DisturbanceObserver::observes)
      .def("reset", &DisturbanceObserver::reset)
      .def("hold", &DisturbanceObserver::hold)
      .def(
          "observe",
          [](DisturbanceObserver& self, double dt, const Numbers& asked, const Numbers& qd) {
            const Eigen::Index n = self.correction().size();
            self.observe(require_tick(dt), asked.vector("asked", n), qd.vector("qd", n));
          },
          py::arg("dt"), py::arg("asked"), py::arg("qd"))
      .property("correction",
                [](const DisturbanceObserver& self) { return Eigen::VectorXd(self.correction()); });

  Class<ComputedTorque> law(module, "ComputedTorque");
  const auto n = [](const ComputedTorque& self) { return self.velocity().size(); };
  law.init(
         [](const RobotModel& model, const ControlSettings& control, const Numbers& posture) {
           return ComputedTorque(sound(model), control, posture.vector("posture", model.dof()));
         },
         py::arg("model"), py::arg("settings"), py::arg("posture"))
      .def(
          "start",
          [n](ComputedTorque& self, const Numbers& qd) {
            self.start(qd.vector("velocity", n(self)));
          },
          py::arg("velocity"))
      .property("velocity",
                [](const ComputedTorque& self) { return Eigen::VectorXd(self.velocity()); })
      .def(
          "go_on",
          [n](ComputedTorque& self, const Numbers& qd) {
            self.go_on(qd.vector("velocity", n(self)));
          },
          py::arg("velocity"))
      .def("hold_observer", &ComputedTorque::hold_observer)
      .def("reset_observer", &ComputedTorque::reset_observer)
      .property("observer",
                [](const ComputedTorque& self) { return DisturbanceObserver(self.observer()); })
      .def(
          "set_gravity",
          [](ComputedTorque& self, const Numbers& gravity) {
            self.set_gravity(finite(gravity.vector("gravity", 3), "gravity"));
          },
          py::arg("gravity"))
      .def(
          "torque",
          [n](ComputedTorque& self, double dt, const Start& now, const Numbers& next,
              const std::optional<Numbers>& q, const std::optional<Numbers>& qd) {
            const auto joints = static_cast<int>(n(self));
            const Sample at = now.of(joints, "now");
            const Eigen::VectorXd to = next.vector("next", joints);
            Eigen::VectorXd torque(joints);
            if (q.has_value() != qd.has_value())
              throw Error("state", "needs both q and qd, or neither");
            if (q)
              self.torque(require_tick(dt), q->vector("q", joints), qd->vector("qd", joints), at,
                          to, torque);
            else
              self.torque(require_tick(dt), at, to, torque);
            return torque;
          },
          py::arg("dt"), py::arg("now"), py::arg("next"), py::arg("q") = py::none(),
          py::arg("qd") = py::none());
}

void bind_hardware(py::module_& module) {
  Class<ActuatorSettings>(module, "ActuatorSettings")
      .field("quantum", &ActuatorSettings::quantum)
      .field("limit_effort", &ActuatorSettings::limit_effort)
      .field("rate", &ActuatorSettings::rate)
      .field("lag", &ActuatorSettings::lag)
      .made_of_fields();
  using SizedActuator = Sized<Actuator>;
  Class<SizedActuator> actuator(module, "Actuator", "Actuator");
  actuator
      .init(
          [](const RobotModel& model, const ActuatorSettings& settings) {
            return SizedActuator{Actuator(model, settings), model.dof()};
          },
          py::arg("model"), py::arg_v("settings", ActuatorSettings{}, "ActuatorSettings()"))
      .def(
          "deliver",
          [](SizedActuator& self, double dt, const Numbers& commanded) {
            return Eigen::VectorXd(
                self.part.deliver(require_tick(dt), commanded.vector("commanded", self.n)));
          },
          py::arg("dt"), py::arg("commanded"))
      .property("limited", [](const SizedActuator& self) { return self.part.limited(); })
      .def(
          "delivered",
          [](const SizedActuator& self, const Numbers& commanded) {
            return Eigen::VectorXd(self.part.delivered(commanded.vector("commanded", self.n)));
          },
          py::arg("commanded"));

  Class<Dropout> dropout(module, "Dropout");
  Enum<Dropout::What>(*dropout, "What", "Dropout::What")
      .value("missing", Dropout::What::missing)
      .value("frozen", Dropout::What::frozen);
  dropout.field("from_", &Dropout::from)
      .field("to", &Dropout::to)
      .field("what", &Dropout::what)
      .made_of_fields();
  Class<SensorSettings>(module, "SensorSettings")
      .field("delay", &SensorSettings::delay)
      .field("resolution", &SensorSettings::resolution)
      .field("position_noise", &SensorSettings::position_noise)
      .field("velocity_noise", &SensorSettings::velocity_noise)
      .field("seed", &SensorSettings::seed)
      .field("dropouts", &SensorSettings::dropouts)
      .made_of_fields();
  using SizedSensor = Sized<Sensor>;
  Class<SizedSensor> sensor(module, "Sensor", "Sensor");
  (*sensor).attr("most_ticks") = Sensor::most_ticks;
  sensor
      .init(
          [](const RobotModel& model, const SensorSettings& settings) {
            return SizedSensor{Sensor(model, settings), model.dof()};
          },
          py::arg("model"), py::arg_v("settings", SensorSettings{}, "SensorSettings()"))
      .property("ideal", [](const SizedSensor& self) { return self.part.ideal(); })
      .def(
          "measure",
          [](SizedSensor& self, double dt, const Numbers& q, const Numbers& qd) {
            self.part.measure(require_tick(dt), q.vector("q", self.n), qd.vector("qd", self.n));
          },
          py::arg("dt"), py::arg("q"), py::arg("qd"))
      .def("forget", [](SizedSensor& self) { self.part.forget(); })
      .property("q", [](const SizedSensor& self) { return Eigen::VectorXd(self.part.q()); })
      .property("qd", [](const SizedSensor& self) { return Eigen::VectorXd(self.part.qd()); });
}

void bind_guard(py::module_& module) {
  Class<GuardSettings>(module, "GuardSettings")
      .field("most_error", &GuardSettings::most_error)
      .field("least_effort", &GuardSettings::least_effort)
      .field("longest_dropout", &GuardSettings::longest_dropout)
      .field("frozen_beyond", &GuardSettings::frozen_beyond)
      .field("beyond_limits", &GuardSettings::beyond_limits)
      .made_of_fields();
  Class<Incident> incident(module, "Incident");
  Enum<Incident::Cause>(*incident, "Cause", "Incident::Cause")
      .value("none", Incident::Cause::none)
      .value("no_state", Incident::Cause::no_state)
      .value("deviation", Incident::Cause::deviation)
      .value("goal", Incident::Cause::goal)
      .value("joint_limit", Incident::Cause::joint_limit)
      .value("unreachable", Incident::Cause::unreachable);
  incident.field("cause", &Incident::cause)
      .field("time", &Incident::time)
      .field("joint", &Incident::joint)
      .field("value", &Incident::value)
      .field("bound", &Incident::bound)
      .made_of_fields();
  def(
      module, "describe",
      [](const Incident& what, const RobotModel& robot) {
        using Cause = Incident::Cause;
        const bool of_joint = what.cause == Cause::deviation || what.cause == Cause::goal ||
                              what.cause == Cause::joint_limit;
        if (what.joint >= robot.dof() || (of_joint && what.joint < 0))
          throw Error("incident", "joint " + std::to_string(what.joint) + ", the robot has " +
                                      std::to_string(robot.dof()));
        return describe(what, robot);
      },
      py::arg("incident"), py::arg("robot"));

  using SizedGuard = Sized<Guard>;
  Class<SizedGuard> guard(module, "Guard", "Guard");
  guard
      .init(
          [](const RobotModel& model, const GuardSettings& settings, double delay,
             const std::optional<Numbers>& stiffness) {
            return SizedGuard{
                Guard(model, settings, delay,
                      stiffness ? stiffness->vector("stiffness", model.dof()) : Eigen::VectorXd()),
                model.dof()};
          },
          py::arg("model"), py::arg_v("settings", GuardSettings{}, "GuardSettings()"),
          py::arg("delay") = 0.0, py::arg("stiffness") = py::none())
      .def(
          "trusts",
          [](SizedGuard& self, double dt, const Numbers& q, const Numbers& qd,
             const Numbers& reference) {
            return self.part.trusts(require_tick(dt), q.vector("q", self.n),
                                    qd.vector("qd", self.n), reference.vector("reference", self.n));
          },
          py::arg("dt"), py::arg("q"), py::arg("qd"), py::arg("reference"))
      .property("dropout", [](const SizedGuard& self) { return self.part.dropout(); })
      .property("lost", [](const SizedGuard& self) { return self.part.lost(); })
      .def(
          "restart",
          [](SizedGuard& self, const Numbers& q) { self.part.restart(q.vector("q", self.n)); },
          py::arg("q"))
      .def(
          "deviation",
          [](const SizedGuard& self, const Numbers& q, const Numbers& reference, bool limited) {
            return self.part.deviation(q.vector("q", self.n), reference.vector("reference", self.n),
                                       limited);
          },
          py::arg("q"), py::arg("reference"), py::arg("limited"))
      .def(
          "beyond_limits",
          [](const SizedGuard& self, const Numbers& position) {
            return self.part.beyond_limits(position.vector("position", self.n));
          },
          py::arg("position"))
      .def(
          "keep_within_limits",
          [](const SizedGuard& self, const Numbers& from, const Numbers& to) {
            Eigen::VectorXd end = to.vector("to", self.n);
            self.part.keep_within_limits(from.vector("from", self.n), end);
            return end;
          },
          "The end `to` (n,) [rad or m] of a motion, moved back to a limit that it would pass: a "
          "new array. What is beyond a limit already may stay there.",
          py::arg("from_"), py::arg("to"));

  using SizedOffset = Sized<FadingOffset>;
  Class<SizedOffset> offset(module, "FadingOffset", "FadingOffset");
  (*offset).attr("duration") = FadingOffset::duration;
  offset
      .init(
          [](int joints) {
            if (joints < 1) throw Error("joints", std::to_string(joints) + ", must be >= 1");
            return SizedOffset{FadingOffset(joints), joints};
          },
          py::arg("joints"))
      .def(
          "start",
          [](SizedOffset& self, const Numbers& position, const Numbers& velocity) {
            self.part.start(position.vector("position", self.n),
                            velocity.vector("velocity", self.n));
          },
          py::arg("position"), py::arg("velocity"))
      .def(
          "shift",
          [](SizedOffset& self, const Numbers& position, const Numbers& velocity) {
            self.part.shift(position.vector("position", self.n),
                            velocity.vector("velocity", self.n));
          },
          py::arg("position"), py::arg("velocity"))
      .def(
          "advance", [](SizedOffset& self, double dt) { self.part.advance(require_step(dt)); },
          py::arg("dt"))
      .property("faded", [](const SizedOffset& self) { return self.part.faded(); })
      .def(
          "add_to",
          [](const SizedOffset& self, const Start& reference) {
            Sample moved = reference.of(static_cast<int>(self.n), "reference");
            self.part.add_to(moved);
            return moved;
          },
          "The reference, a Sample of n joints, with the present offset added: a new Sample.",
          py::arg("reference"));
}

}  // namespace

void bind_dynamics(py::module_& module) {
  bind_inverse_dynamics(module);
  bind_law(module);
  bind_hardware(module);
  bind_guard(module);
}

}  // namespace seam::python
