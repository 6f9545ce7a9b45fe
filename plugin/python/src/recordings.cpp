// Recordings and what is measured on them.
#include <cmath>

#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/pandas.hpp"
#include "plugin/python/src/parts.hpp"
#include <seam/metrics.hpp>
#include <seam/recording.hpp>
#include <seam/testing.hpp>

namespace seam::python {

// An array whose columns have names.
struct NamedColumns {
  py::object value;
};

}  // namespace seam::python

namespace pybind11::detail {

template <>
struct type_caster<seam::python::NamedColumns> {
  static constexpr auto name = const_name("seam.Columns");
  static handle cast(const seam::python::NamedColumns& from, return_value_policy, handle) {
    return handle(from.value).inc_ref();
  }
};

}  // namespace pybind11::detail

namespace seam::python {

namespace {

using Names = std::vector<std::string>;

NamedColumns named(const Eigen::MatrixXd& values, const Names& names, const py::object& owner) {
  static const char* const module = "seam._columns";
  if (values.size() == 0) {
    const Eigen::MatrixXd none(0, static_cast<Eigen::Index>(names.size()));
    return {py::module_::import(module).attr("named")(read_only(none), py::cast(names))};
  }
  return {py::module_::import(module).attr("named")(view_of(values, owner), py::cast(names))};
}

// Values by name: of signals, and of what came of a run.
template <typename Item, typename Value>
std::function<void(Recording&, py::handle)> set_by_name(std::vector<Item> Recording::*list) {
  return [list](Recording& recording, py::handle given) {
    (recording.*list).clear();
    for (const auto& [key, value] :
         py::reinterpret_borrow<py::dict>(py::dict(py::reinterpret_borrow<py::object>(given)))) {
      Item item;
      item.name = py::str(key).template cast<std::string>();
      assign(item.*Value::member, value, "Recording " + item.name);
      (recording.*list).push_back(std::move(item));
    }
  };
}
struct OfSignal {
  static constexpr auto member = &Signal::values;
};
struct OfOutcome {
  static constexpr auto member = &Outcome::value;
};

auto columns(Eigen::MatrixXd Recording::*values, Names Recording::*names) {
  return [values, names](const py::object& self) {
    const auto& recording = self.cast<const Recording&>();
    return named(recording.*values, recording.*names, self);
  };
}

template <typename Values>
auto column(Values Recording::*values) {
  return [values](const py::object& self) {
    return ArrayOf<Values>{view_of(self.cast<const Recording&>().*values, self)};
  };
}

void bind_recording(py::module_& module) {
  Class<RecordedJoin>(module, "RecordedJoin")
      .field("time", &RecordedJoin::time)
      .field("primitive", &RecordedJoin::primitive)
      .field("acceleration_jump", &RecordedJoin::acceleration_jump)
      .field("linear_jump", &RecordedJoin::linear_jump)
      .made_of_fields();

  Class<Recording> recording(module, "Recording");
  recording.fixed("joints", &Recording::joints)
      .fixed("slides", &Recording::slides)
      .fixed("effort", &Recording::effort)
      .fixed("time", &Recording::time, column(&Recording::time))
      .fixed("running", &Recording::running, column(&Recording::running))
      .fixed("ref", &Recording::ref, columns(&Recording::ref, &Recording::joints))
      .fixed("ref_vel", &Recording::ref_vel, columns(&Recording::ref_vel, &Recording::joints))
      .fixed("ref_acc", &Recording::ref_acc, columns(&Recording::ref_acc, &Recording::joints))
      .fixed("q", &Recording::q, columns(&Recording::q, &Recording::joints))
      .fixed("qd", &Recording::qd, columns(&Recording::qd, &Recording::joints))
      .fixed("torque", &Recording::torque, columns(&Recording::torque, &Recording::joints))
      .fixed("joins", &Recording::joins)
      .fixed("coordinates", &Recording::coordinates)
      .fixed("tool_ref", &Recording::tool_ref,
             columns(&Recording::tool_ref, &Recording::coordinates))
      .fixed("tool_vel", &Recording::tool_vel,
             columns(&Recording::tool_vel, &Recording::coordinates))
      .fixed("tool_acc", &Recording::tool_acc,
             columns(&Recording::tool_acc, &Recording::coordinates))
      .fixed("tool_error_m", &Recording::tool_error_m, column(&Recording::tool_error_m))
      .fixed("tool_error_rad", &Recording::tool_error_rad, column(&Recording::tool_error_rad))
      .fixed_by("signals", set_by_name<Signal, OfSignal>(&Recording::signals),
                [](const py::object& self) {
                  py::dict signals;
                  for (const Signal& signal : self.cast<const Recording&>().signals)
                    signals[signal.name.c_str()] = view_of(signal.values, self);
                  return signals;
                })
      .fixed_by("outcomes", set_by_name<Outcome, OfOutcome>(&Recording::outcomes),
                [](const Recording& self) {
                  py::dict outcomes;
                  for (const Outcome& outcome : self.outcomes)
                    outcomes[outcome.name.c_str()] = outcome.value;
                  return outcomes;
                })
      .fixed("incident", &Recording::incident)
      .fixed("source", &Recording::source)
      .made_of_many_fields();
  recording.property("ticks", &Recording::ticks)
      .property("dt",
                [](const Recording& self) {
                  if (self.ticks() < 2) throw Error(self.source, "fewer than 2 ticks");
                  return self.dt();
                })
      .def(
          "slides_at",
          [](const Recording& self, std::size_t joint) { return self.slides_at(joint); },
          py::arg("joint"))
      .property("in_task_space", &Recording::in_task_space)
      .def("validate", &Recording::validate)
      .def_static(
          "read", [](const Path& path) { return Recording::read(path); }, py::arg("path"),
          py::call_guard<py::gil_scoped_release>())
      .def(
          "write", [](const Recording& self, const Path& path) { self.write(path); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>());
  (*recording).def("to_pandas", &to_pandas, to_pandas_doc);
  (*recording).def("__repr__", [](const Recording& self) {
    const auto counted = [](std::size_t count, const char* what) {
      return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
    };
    return "<Recording " + self.source + ": " +
           counted(static_cast<std::size_t>(self.ticks()), "tick") + ", " +
           counted(self.joints.size() + self.coordinates.size(), "column") + ", " +
           counted(self.joins.size(), "join") + ">";
  });
}

// The same with joins at other times [s].
Recording joined_at(const Recording& recording, const Numbers& times) {
  Recording other = recording;
  other.joins.clear();
  for (const double time : times.vector("joins")) {
    if (!std::isfinite(time)) throw Error("joins", "must be finite times [s]");
    other.joins.push_back({time});
  }
  return other;
}

void bind_metrics(py::module_& module) {
  module.attr("unknown") = unknown;
  def(
      module, "jump",
      [](const Numbers& time, const Numbers& signal, double at, int line_ticks) {
        const Eigen::VectorXd t = time.vector("time");
        const Eigen::MatrixXd values = signal.matrix("signal");
        if (values.rows() != t.size())
          throw Error("signal", "has " + std::to_string(values.rows()) + " rows, must have " +
                                    std::to_string(t.size()) + " as time");
        if (t.size() < 2) throw Error("time", "fewer than 2 ticks");
        if (line_ticks < 2)
          throw Error("line_ticks", std::to_string(line_ticks) + ", must be >= 2");
        return jump(t, values, at, line_ticks);
      },
      py::arg("time"), py::arg("signal"), py::arg("at"), py::arg("line_ticks") = 3);
  def(module, "jump_order", &jump_order, py::arg("at_dt"), py::arg("at_half_dt"));
  Class<MetricSettings>(module, "MetricSettings")
      .field("line_ticks", &MetricSettings::line_ticks)
      .field("after_join", &MetricSettings::after_join)
      .field("faded_share", &MetricSettings::faded_share)
      .made_of_fields();
  using J = JoinMetrics;
  Class<J>(module, "JoinMetrics")
      .field("time", &J::time)
      .field("joint", &J::joint)
      .field("torque_jump_nm", &J::torque_jump_nm)
      .field("torque_jump_percent", &J::torque_jump_percent)
      .field("torque_jump_order", &J::torque_jump_order)
      .field("acceleration_jump_rad_s2", &J::acceleration_jump_rad_s2)
      .field("acceleration_jump_m_s2", &J::acceleration_jump_m_s2)
      .field("acceleration_jump_error_rad_s2", &J::acceleration_jump_error_rad_s2)
      .field("acceleration_jump_error_m_s2", &J::acceleration_jump_error_m_s2)
      .field("tracking_max_rad", &J::tracking_max_rad)
      .field("tool_tracking_max_m", &J::tool_tracking_max_m)
      .field("tool_tracking_max_rad", &J::tool_tracking_max_rad)
      .field("deviation_peak_rad", &J::deviation_peak_rad)
      .field("deviation_faded_s", &J::deviation_faded_s)
      .made_of_fields();
  using R = RunMetrics;
  Class<R>(module, "RunMetrics")
      .field("joins", &R::joins)
      .field("torque_jump_nm", &R::torque_jump_nm)
      .field("torque_jump_percent", &R::torque_jump_percent)
      .field("torque_jump_order", &R::torque_jump_order)
      .field("acceleration_jump_rad_s2", &R::acceleration_jump_rad_s2)
      .field("acceleration_jump_m_s2", &R::acceleration_jump_m_s2)
      .field("acceleration_jump_error_rad_s2", &R::acceleration_jump_error_rad_s2)
      .field("acceleration_jump_error_m_s2", &R::acceleration_jump_error_m_s2)
      .field("torque_rate_peak_nm_s", &R::torque_rate_peak_nm_s)
      .field("torque_rate_rms_nm_s", &R::torque_rate_rms_nm_s)
      .field("jerk_peak_rad_s3", &R::jerk_peak_rad_s3)
      .field("jerk_rms_rad_s3", &R::jerk_rms_rad_s3)
      .field("tracking_max_rad", &R::tracking_max_rad)
      .field("tracking_rms_rad", &R::tracking_rms_rad)
      .field("tracking_after_join_max_rad", &R::tracking_after_join_max_rad)
      .field("tool_tracking_max_m", &R::tool_tracking_max_m)
      .field("tool_tracking_rms_m", &R::tool_tracking_rms_m)
      .field("tool_tracking_max_rad", &R::tool_tracking_max_rad)
      .field("tool_tracking_rms_rad", &R::tool_tracking_rms_rad)
      .field("tool_tracking_after_join_max_m", &R::tool_tracking_after_join_max_m)
      .field("tool_tracking_after_join_max_rad", &R::tool_tracking_after_join_max_rad)
      .field("saturated_share", &R::saturated_share)
      .field("deviation_peak_rad", &R::deviation_peak_rad)
      .field("deviation_peak_m", &R::deviation_peak_m)
      .field("deviation_faded_s", &R::deviation_faded_s)
      .made_of_fields();
  module.def(
      "measure",
      [](const Recording& recording, const Recording* half, const Recording* dmp2,
         const MetricSettings& settings, const std::optional<Numbers>& joins) {
        const MetricSettings chosen = settings;  // others may change theirs meanwhile
        std::optional<Recording> rejoined, half_rejoined;
        if (joins) {
          rejoined = joined_at(recording, *joins);
          if (half) half_rejoined = joined_at(*half, *joins);
        }
        py::gil_scoped_release others_go_on;
        return measure(rejoined ? *rejoined : recording,
                       {half_rejoined ? &*half_rejoined : half, dmp2}, chosen);
      },
      (std::string(doc("measure")) +
       "\n\nArgs:\n    half: the same run at dt/2: gives the orders\n"
       "    dmp2: the same run with dmp2, at the same dt: gives the deviations\n"
       "    joins: (J,) times [s] of the joins, instead of those that the recordings have")
          .c_str(),
      py::arg("recording"), py::arg("half") = py::none(), py::arg("dmp2") = py::none(),
      py::arg_v("settings", MetricSettings{}, "MetricSettings()"), py::arg("joins") = py::none());
}

template <typename Matcher>
void bind_matcher(Class<Matcher>& matcher) {
  matcher
      .def_as(
          "why_not", "why_not",
          [](const Matcher& self, const Recording& recording) {
            recording.validate();
            return self.why_not(recording);
          },
          py::arg("recording"))
      .def("wanted", &Matcher::wanted);
}

// For users' tests.
void bind_testing(py::module_& module) {
  Class<NoJump> no_jump(module, "NoJump");
  no_jump.def("fitting", &NoJump::fitting, py::arg("line_ticks"));
  bind_matcher(no_jump);
  Class<TorqueIsContinuousAt>(module, "TorqueIsContinuousAt")
      .init([](double time) { return TorqueIsContinuousAt(time); }, py::arg("time"))
      .def("within", &TorqueIsContinuousAt::within, py::arg("limit_nm"));
  Class<TorqueIsContinuousAtAllJoins> all(module, "TorqueIsContinuousAtAllJoins");
  (*all).def(py::init<>(), "The torque of every joint, at every join of the recording.");
  all.def("within", &TorqueIsContinuousAtAllJoins::within, py::arg("limit_nm"));
  Class<AccelerationIsContinuousAt>(module, "AccelerationIsContinuousAt")
      .init([](double time) { return AccelerationIsContinuousAt(time); }, py::arg("time"))
      .def("within", &AccelerationIsContinuousAt::within, py::arg("limit_rad_s2"));
  Class<TracksWithin> tracks(module, "TracksWithin");
  tracks.init([](double limit) { return TracksWithin(limit); }, py::arg("limit_rad"));
  bind_matcher(tracks);
}

}  // namespace

void bind_recordings(py::module_& module) {
  bind_recording(module);
  bind_metrics(module);
  bind_testing(module);
}

}  // namespace seam::python
