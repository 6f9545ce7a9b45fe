// Demonstrations, primitives and what they are made of.
#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/pandas.hpp"
#include "plugin/python/src/parts.hpp"
#include <seam/basis.hpp>
#include <seam/demonstration.hpp>
#include <seam/orientation.hpp>
#include <seam/primitive.hpp>
#include <seam/primitive_file.hpp>

namespace seam::python {

namespace {

using Names = std::vector<std::string>;

// The columns of a dictionary or a frame of pandas.
struct Columns {
  Names names;
  Eigen::MatrixXd values;
};

Columns columns_of(const py::object& table, Eigen::Index rows, const std::string& place) {
  Columns columns;
  const py::list keys(table.attr("keys")());
  columns.values.resize(rows, static_cast<Eigen::Index>(keys.size()));
  for (const py::handle key : keys) {
    columns.names.push_back(py::str(key).cast<std::string>());
    const Numbers numbers{table[key]};
    columns.values.col(static_cast<Eigen::Index>(columns.names.size()) - 1) =
        numbers.vector(place + " " + columns.names.back(), rows);
  }
  return columns;
}

bool has_columns(const py::object& given) {
  return py::isinstance<py::dict>(given) || py::hasattr(given, "columns");
}

// Values of known columns, from an array or by name.
Eigen::MatrixXd values_of(const py::object& given, const Names& names, Eigen::Index rows,
                          const std::string& place) {
  if (!has_columns(given)) return Numbers{given}.matrix(place);
  Eigen::MatrixXd values(rows, static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const py::str key(names[i]);
    if (!given.attr("__contains__")(key).cast<bool>())
      throw Error(place, "has no \"" + names[i] + "\", must have all coordinates");
    values.col(static_cast<Eigen::Index>(i)) =
        Numbers{given[key]}.vector(place + " " + names[i], rows);
  }
  return values;
}

// Takes the columns PREFIX.COORDINATE out, in the order of the coordinates; none where there are none.
py::object take(const std::string& prefix, Columns& columns) {
  Names names;
  std::vector<Eigen::Index> kept;
  py::dict taken;
  for (std::size_t i = 0; i < columns.names.size(); ++i) {
    const std::string& name = columns.names[i];
    const auto column = static_cast<Eigen::Index>(i);
    if (name.rfind(prefix, 0) == 0) {
      taken[name.substr(prefix.size()).c_str()] = Eigen::VectorXd(columns.values.col(column));
      continue;
    }
    names.push_back(name);
    kept.push_back(column);
  }
  columns = {names, Eigen::MatrixXd(columns.values(Eigen::all, kept))};
  return taken.empty() ? py::object(py::none()) : py::object(taken);
}

Names numbered(Eigen::Index count) {
  Names names;
  for (Eigen::Index i = 0; i < count; ++i) names.push_back("y" + std::to_string(i + 1));
  return names;
}

// Of a frame of pandas: its column `time`, else its index.
std::pair<Eigen::VectorXd, py::object> split_frame(const py::object& frame) {
  const py::str key("time");
  const bool has_time = frame.attr("__contains__")(key).cast<bool>();
  const Numbers time{has_time ? py::object(frame[key]) : frame.attr("index")};
  const py::object rest = has_time ? frame.attr("drop")(py::arg("columns") = key) : frame;
  return {time.vector("time"), rest};
}

Demonstration demonstration(const py::object& first, const py::object& position,
                            const Names& coordinates, py::object velocity, py::object acceleration,
                            const std::optional<Eigen::Quaterniond>& reference, double cutoff,
                            const std::string& source) {
  const bool frame = position.is_none() && py::hasattr(first, "columns");
  auto [time, table] =
      frame ? split_frame(first) : std::pair(Numbers{first}.vector("time"), py::object(position));
  if (table.is_none())
    throw Error("demonstration", "needs time and position, or a frame of pandas");
  Columns columns{coordinates, {}};
  if (has_columns(table) && coordinates.empty())
    columns = columns_of(table, time.size(), "position");
  else
    columns.values = values_of(table, coordinates, time.size(), "position");
  if (frame) {  // as in a CSV file
    const py::object own_velocity = take("vel.", columns), own_acceleration = take("acc.", columns);
    if (velocity.is_none()) velocity = own_velocity;
    if (acceleration.is_none()) acceleration = own_acceleration;
  }
  if (columns.names.empty()) columns.names = numbered(columns.values.cols());

  if (velocity.is_none() && acceleration.is_none()) {
    py::gil_scoped_release others_go_on;
    Demonstration demo = Demonstration::from_positions(columns.names, time, columns.values,
                                                       DerivativeSettings{cutoff});
    demo.reference_orientation = reference;
    demo.source = source;
    demo.validate();
    return demo;
  }
  Demonstration demo;
  demo.coordinates = columns.names;
  demo.time = time;
  demo.position = columns.values;
  const auto require = [&](const Eigen::MatrixXd& values, const char* place) {
    require_shape(values, demo.time.size(), static_cast<Eigen::Index>(demo.coordinates.size()),
                  place);
  };
  require(demo.position, "position");
  const auto slopes = [&](const py::object& given, const Eigen::MatrixXd& of, const char* place) {
    if (!given.is_none()) return values_of(given, columns.names, time.size(), place);
    return Demonstration::from_positions(columns.names, time, of, DerivativeSettings{cutoff})
        .velocity;
  };
  demo.velocity = slopes(velocity, demo.position, "velocity");
  require(demo.velocity, "velocity");
  demo.acceleration = slopes(acceleration, demo.velocity, "acceleration");
  require(demo.acceleration, "acceleration");
  demo.reference_orientation = reference;
  demo.source = source;
  demo.validate();
  return demo;
}

void bind_demonstration(py::module_& module) {
  Class<DerivativeSettings>(module, "DerivativeSettings")
      .field("cutoff", &DerivativeSettings::cutoff)
      .made_of_fields();
  Class<Demonstration> demo(module, "Demonstration");
  demo.def_static(
      "read",
      [](const Path& path, const DerivativeSettings& settings) {
        return Demonstration::read(path, settings);
      },
      py::arg("path"), py::arg_v("settings", DerivativeSettings{}, "DerivativeSettings()"),
      py::call_guard<py::gil_scoped_release>());
  (*demo).def(py::init(&demonstration), py::arg("time"), py::arg("position") = py::none(),
              py::arg("coordinates") = Names{}, py::arg("velocity") = py::none(),
              py::arg("acceleration") = py::none(), py::arg("reference_orientation") = py::none(),
              py::arg("cutoff") = 6.0, py::arg("source") = "demonstration",
              "From arrays: time [s] (N,), and positions as a dict of names and (N,), as an array "
              "(N, D) with the names in "
              "`coordinates` (else y1, y2, …), or as a frame of pandas. A frame alone has a column "
              "`time`, else its index is "
              "the time. Velocities and accelerations, in the same ways, are taken from the "
              "positions by a smoothing fit where "
              "they are not given; `cutoff` [Hz] is that of DerivativeSettings.\n\nRaises:\n    "
              "Error: whatever "
              "Demonstration.validate refuses");
  const auto view = [](auto member) {
    return [member](py::object self) {
      using M = std::remove_reference_t<decltype(self.cast<Demonstration&>().*member)>;
      return ArrayOf<M>{view_of(self.cast<Demonstration&>().*member, self)};
    };
  };
  (*demo).def(py::pickle(
      [](const Demonstration& d) {
        return py::make_tuple(d.coordinates, d.time, d.position, d.velocity, d.acceleration,
                              d.source, d.reference_orientation);
      },
      [](const py::tuple& state) {
        Demonstration made{state[0].cast<Names>(),
                           state[1].cast<Eigen::VectorXd>(),
                           state[2].cast<Eigen::MatrixXd>(),
                           state[3].cast<Eigen::MatrixXd>(),
                           state[4].cast<Eigen::MatrixXd>(),
                           state[5].cast<std::string>(),
                           state[6].cast<std::optional<Eigen::Quaterniond>>()};
        made.validate();
        return made;
      }));
  demo.property("coordinates",
                [](const Demonstration& d) {
                  return TupleOf<std::string>{py::tuple(py::cast(d.coordinates))};
                })
      .property("time", view(&Demonstration::time))
      .property("position", view(&Demonstration::position))
      .property("velocity", view(&Demonstration::velocity))
      .property("acceleration", view(&Demonstration::acceleration))
      .property("source", [](const Demonstration& d) { return d.source; })
      .property("reference_orientation",
                [](const Demonstration& d) { return d.reference_orientation; })
      .property("samples", &Demonstration::samples)
      .property("dimensions", &Demonstration::dimensions)
      .property("duration", &Demonstration::duration)
      .def_static(
          "from_positions",
          [](const Names& coordinates, const Numbers& time, const Numbers& position,
             const DerivativeSettings& settings) {
            return Demonstration::from_positions(coordinates, time.vector("time"),
                                                 position.matrix("position"), settings);
          },
          py::arg("coordinates"), py::arg("time"), py::arg("position"),
          py::arg_v("settings", DerivativeSettings{}, "DerivativeSettings()"))
      .def("resample", &Demonstration::resample, py::arg("rate"),
           py::call_guard<py::gil_scoped_release>())
      .def("validate", &Demonstration::validate)
      .def("require_coordinates", &Demonstration::require_coordinates, py::arg("names"));
  (*demo).def("to_pandas", &to_pandas, to_pandas_doc);
  (*demo).def("__repr__", [](const Demonstration& d) {
    std::string names;
    for (const std::string& name : d.coordinates) names += (names.empty() ? "" : ", ") + name;
    return "<Demonstration " + d.source + ": " + std::to_string(d.samples()) + " samples of " +
           names + ">";
  });
}

void bind_primitive(py::module_& module) {
  Enum<Kind>(module, "Kind", "Kind")
      .value("discrete", Kind::discrete)
      .value("rhythmic", Kind::rhythmic);
  Class<Gains> gains(module, "Gains");
  gains.field("K", &Gains::K).field("D", &Gains::D).field("H", &Gains::H).made_of_fields();
  gains.def_static("critical", &Gains::critical, py::arg("K")).def_static("paper", &Gains::paper);
  Class<Kernels> kernels(module, "Kernels");
  kernels.field("centers", &Kernels::centers).field("widths", &Kernels::widths).made_of_fields();
  kernels.property("count", &Kernels::count)
      .def_static("even_in_time", &Kernels::even_in_time, py::arg("count"), py::arg("width"),
                  py::arg("alpha"))
      .def_static("even_in_phase", &Kernels::even_in_phase, py::arg("count"), py::arg("width"));
  Class<Bounds> bounds(module, "Bounds");
  bounds.field("least", &Bounds::least).field("largest", &Bounds::largest).made_of_fields();
  bounds.def("hold", &Bounds::hold, py::arg("value"));
  module.attr("tau_bounds") = tau_bounds;
  module.attr("gain_bounds") = gain_bounds;
  module.attr("alpha_bounds") = alpha_bounds;
  module.attr("center_bounds") = center_bounds;
  module.attr("width_bounds") = width_bounds;
  module.attr("value_bounds") = value_bounds;

  Class<Primitive> primitive(module, "Primitive");
  primitive.field("kind", &Primitive::kind)
      .field("coordinates", &Primitive::coordinates)
      .field("gains", &Primitive::gains)
      .field("alpha", &Primitive::alpha)
      .field("kernels", &Primitive::kernels)
      .field("weights", &Primitive::weights)
      .field("goal", &Primitive::goal)
      .field("tau", &Primitive::tau)
      .field("start_position", &Primitive::start_position)
      .field("start_velocity", &Primitive::start_velocity)
      .field("start_acceleration", &Primitive::start_acceleration)
      .field("reference_orientation", &Primitive::reference_orientation)
      .made_of_fields();
  primitive.property("dimensions", &Primitive::dimensions)
      .def("at_speed", &Primitive::at_speed, py::arg("factor"))
      .def("validate", &Primitive::validate);
  (*primitive)
      .def_static(
          "read", [](const Path& path) { return read_primitive(path); }, doc("read_primitive"),
          py::arg("path"));
  (*primitive)
      .def(
          "write", [](const Primitive& p, const Path& path) { write_primitive(path, p); },
          doc("write_primitive"), py::arg("path"));
  def(
      module, "read_primitive", [](const Path& path) { return read_primitive(path); },
      py::arg("path"));
  def(
      module, "write_primitive",
      [](const Path& path, const Primitive& p) { write_primitive(path, p); }, py::arg("path"),
      py::arg("primitive"));
}

void bind_basis(py::module_& module) {
  Class<Basis> basis(module, "Basis");
  basis
      .init(
          [](const Primitive& primitive) {
            primitive.validate();
            return Basis(primitive);
          },
          py::arg("primitive"))
      .property("kind", &Basis::kind)
      .property("count", &Basis::count)
      .property("start_phase", &Basis::start_phase)
      .def("advance", &Basis::advance, py::arg("phase"), py::arg("t"), py::arg("tau"))
      .def("time_to", &Basis::time_to, py::arg("later"), py::arg("phase"), py::arg("tau"))
      .def("next", &Basis::next, py::arg("value"), py::arg("phase"))
      .def("phase_rate", &Basis::phase_rate, py::arg("phase"), py::arg("tau"))
      .def(
          "regressor",
          [](const Basis& self, double phase) {
            Eigen::VectorXd row(self.count());
            self.regressor(phase, row.data());
            return row;
          },
          "The regressor a (M,) at a phase: aⱼ(p) = s·ψⱼ(p)/Σψ(p), s = x or 1, so that f = a @ "
          "weights (Eqs. 2, 9).",
          py::arg("phase"))
      .def(
          "slope",
          [](const Basis& self, double phase) {
            Eigen::VectorXd row(self.count()), slope(self.count());
            self.regressor(phase, row.data());
            self.slope(phase, row.data(), slope.data());
            return slope;
          },
          "da/dp (M,) at a phase.", py::arg("phase"));
}

void bind_orientation(py::module_& module) {
  Class<RotationState>(module, "RotationState")
      .field("vector", &RotationState::vector)
      .field("velocity", &RotationState::velocity)
      .field("acceleration", &RotationState::acceleration)
      .made_of_fields();
  Class<OrientationState>(module, "OrientationState")
      .field("orientation", &OrientationState::orientation)
      .field("velocity", &OrientationState::velocity)
      .field("acceleration", &OrientationState::acceleration)
      .made_of_fields();
  using Quaternion = Eigen::Quaterniond;
  def(module, "rotation_vector",
      py::overload_cast<const Quaternion&, const Quaternion&>(&rotation_vector),
      "The shorter rotation vector (3,) [rad] of q·q0⁻¹, its length in [0, π]; q and −q give the "
      "same.\n\nArgs:\n    q, q0: unit quaternions x y z w (4,)",
      py::arg("q"), py::arg("q0"));
  def(
      module, "orientation",
      [](const Numbers& vector, const Quaternion& q0) {
        return orientation(Eigen::Vector3d(vector.vector("vector", 3)), q0);
      },
      py::arg("vector"), py::arg("q0"));
  module.def(
      "to_orientation",
      [](const RotationState& from, const Quaternion& q0) {
        OrientationState to;
        const bool within = to_orientation(from, q0, to);
        return std::pair(within, to);
      },
      "(within, state): q = exp(ρ)·q0, ω = J(ρ)ρ̇, ω̇ = J(ρ)ρ̈ + J̇ρ̇ with the left Jacobian of SO(3), "
      "for a RotationState.\n\nReturns:\n    (bool, OrientationState): False where the state is "
      "not finite, or beyond π of q0 (the state is then still right)",
      py::arg("state"), py::arg("q0"));
  module.def(
      "to_rotation",
      [](const OrientationState& from, const Quaternion& q0, const Numbers& near) {
        RotationState to;
        to.vector = near.vector("near", 3);
        const bool within = to_rotation(from, q0, to);
        return std::pair(within, to);
      },
      "The inverse of to_orientation, for an OrientationState: of the two vectors of q·q0⁻¹ that "
      "which is nearer to `near` (3,) [rad]; the last "
      "tick's vector follows a motion across π.\n\nReturns:\n    (bool, RotationState): False "
      "where the state is not finite, or beyond π of q0 (the state is then still right, up to 2π)",
      py::arg("state"), py::arg("q0"), py::arg("near") = std::vector<double>(3, 0.0));
  def(module, "has_orientation", &has_orientation, py::arg("demo"));
  def(module, "first_orientation", &first_orientation, py::arg("demo"));
  def(module, "with_rotation_vector", &with_rotation_vector, py::arg("demo"), py::arg("q0"),
      py::arg_v("settings", DerivativeSettings{}, "DerivativeSettings()"));
  def(module, "with_reference", &with_reference, py::arg("demo"), py::arg("q0"));
  def(module, "has_rotation_vector", &has_rotation_vector, py::arg("coordinates"));
  module.attr("unit_tolerance") = unit_tolerance;
}

}  // namespace

void bind_primitives(py::module_& module) {
  bind_demonstration(module);
  bind_primitive(module);
  bind_basis(module);
  bind_orientation(module);
}

}  // namespace seam::python
