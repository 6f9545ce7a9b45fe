// A robot as a model.
#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/parts.hpp"
#include "plugin/python/src/states.hpp"
#include <seam/robot_model.hpp>

namespace seam::python {

namespace {

// The items themselves, which can be changed; the list cannot, so that they stay where they are.
template <typename Item>
auto items(std::vector<Item> RobotModel::*list) {
  return [list](const py::object& self) {
    auto& model = self.cast<RobotModel&>();
    py::tuple tuple((model.*list).size());
    for (std::size_t i = 0; i < tuple.size(); ++i)
      tuple[i] = py::cast(&(model.*list)[i], py::return_value_policy::reference_internal, self);
    return TupleOf<Item>{tuple};
  };
}

void bind_parts(py::module_& module) {
  Class<Inertial> inertial(module, "Inertial");
  inertial.field("mass", &Inertial::mass)
      .field("com", &Inertial::com)
      .field("inertia", &Inertial::inertia)
      .made_of_fields();
  inertial.def("about_origin", &Inertial::about_origin);
  (*inertial)
      .def(
          "__add__", [](const Inertial& a, const Inertial& b) { return a + b; }, doc("operator+"),
          py::is_operator())
      .def(
          "seen_from", [](const Inertial& b, const Eigen::Isometry3d& X_a_b) { return X_a_b * b; },
          doc("operator*"), py::arg("X_a_b"));

  Class<Geometry> geometry(module, "Geometry");
  Enum<Geometry::Type>(*geometry, "Type", "Geometry::Type")
      .value("box", Geometry::Type::box)
      .value("cylinder", Geometry::Type::cylinder)
      .value("sphere", Geometry::Type::sphere)
      .value("mesh", Geometry::Type::mesh)
      .value("capsule", Geometry::Type::capsule);
  geometry.field("type", &Geometry::type)
      .field("X_body_shape", &Geometry::X_body_shape)
      .field("size", &Geometry::size)
      .field("mesh", &Geometry::mesh)
      .field("scale", &Geometry::scale)
      .field("colour", &Geometry::colour)
      .field("has_colour", &Geometry::has_colour)
      .field("link", &Geometry::link)
      .made_of_fields();
  Class<Body>(module, "Body")
      .field("link", &Body::link)
      .field("inertial", &Body::inertial)
      .field("visuals", &Body::visuals)
      .field("collisions", &Body::collisions)
      .made_of_fields();

  Class<Joint> joint(module, "Joint");
  Enum<Joint::Type>(*joint, "Type", "Joint::Type")
      .value("revolute", Joint::Type::revolute)
      .value("continuous", Joint::Type::continuous)
      .value("prismatic", Joint::Type::prismatic);
  joint.field("name", &Joint::name)
      .fixed("type", &Joint::type)
      .fixed("parent", &Joint::parent)
      .field("X_parent_body", &Joint::X_parent_body)
      .field("axis", &Joint::axis)
      .field("lower", &Joint::lower)
      .field("upper", &Joint::upper)
      .field("speed", &Joint::speed)
      .field("effort", &Joint::effort)
      .field("damping", &Joint::damping)
      .field("friction", &Joint::friction)
      .field("rotor_inertia", &Joint::rotor_inertia)
      .field("stiffness", &Joint::stiffness)
      .field("spring_damping", &Joint::spring_damping)
      .fixed("leader", &Joint::leader)
      .field("multiplier", &Joint::multiplier)
      .field("offset", &Joint::offset)
      .made_of_fields();
  joint.property("follows", &Joint::follows)
      .property("is_elastic", &Joint::is_elastic)
      .def("X_parent_body_at", &Joint::X_parent_body_at, py::arg("q"));
  Class<Frame>(module, "Frame")
      .field("name", &Frame::name)
      .fixed("body", &Frame::body)
      .field("X_body_frame", &Frame::X_body_frame)
      .made_of_fields();
  Class<UrdfSettings>(module, "UrdfSettings")
      .field("package_path", &UrdfSettings::package_path)
      .field("leave_out_missing_meshes", &UrdfSettings::leave_out_missing_meshes)
      .made_of_fields();
}

void bind_model(py::module_& module) {
  Class<RobotModel> model(module, "RobotModel");
  model.field("name", &RobotModel::name)
      .field("base", &RobotModel::base)
      .fixed("joints", &RobotModel::joints, items(&RobotModel::joints))
      .fixed("bodies", &RobotModel::bodies, items(&RobotModel::bodies))
      .fixed("frames", &RobotModel::frames, items(&RobotModel::frames))
      .fixed("missing_meshes", &RobotModel::missing_meshes)
      .fixed("warnings", &RobotModel::warnings);
  model.property("dof", &RobotModel::dof)
      .property("is_elastic", &RobotModel::is_elastic)
      .def("joint", &RobotModel::joint, py::arg("joint_name"))
      .def("frame", &RobotModel::frame, py::arg("link_name"),
           py::return_value_policy::reference_internal)
      .def(
          "place_followers",
          [](const RobotModel& self, const Numbers& q) {
            Eigen::VectorXd placed = q.vector("q", self.dof());
            self.place_followers(placed);
            return placed;
          },
          "Joint positions q (n,) [rad or m] with every follower where its leader has it: a new "
          "array.",
          py::arg("q"))
      .def("neutral", &RobotModel::neutral)
      .def(
          "moved_inertia",
          [](const RobotModel& self, const Numbers& q) {
            return self.moved_inertia(q.vector("q", self.dof()));
          },
          py::arg("q"))
      .def_static(
          "read",
          [](const Path& path, const std::vector<std::string>& package_path, bool leave_out) {
            return RobotModel::read(path, UrdfSettings{package_path, leave_out});
          },
          py::arg("urdf_path"), py::arg("package_path") = std::vector<std::string>{},
          py::arg("leave_out_missing_meshes") = false, py::call_guard<py::gil_scoped_release>());
  (*model)
      .def("__copy__", [](const RobotModel& self) { return RobotModel(self); })
      .def("__deepcopy__", [](const RobotModel& self, const py::dict&) { return RobotModel(self); })
      .def("__repr__", [](const RobotModel& self) {
        return "<RobotModel " + self.name + ": " + std::to_string(self.dof()) + " joints>";
      });
}

}  // namespace

const RobotModel& sound(const RobotModel& model) {
  constexpr double rounding = 1e-6;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const Inertial& body = model.bodies[i].inertial;
    const auto require = [&](bool is_good, const char* what) {
      if (!is_good) throw Error(model.name, "joint \"" + joint.name + "\": " + what);
    };
    const auto not_negative = [](double value) { return value >= 0.0 && std::isfinite(value); };
    require(std::abs(joint.axis.norm() - 1.0) < rounding, "its axis must have length 1");
    require(std::isfinite(body.mass) && body.com.allFinite() && body.inertia.allFinite(),
            "mass, centre of mass and inertia of its body must be finite");
    require(not_negative(joint.damping) && not_negative(joint.friction) &&
                not_negative(joint.rotor_inertia) && not_negative(joint.spring_damping),
            "damping, friction, rotor_inertia and spring_damping must be >= 0");
    require(joint.stiffness > 0.0 && joint.effort >= 0.0, "stiffness must be > 0, effort >= 0");
    require(std::isfinite(joint.multiplier) && std::isfinite(joint.offset),
            "multiplier and offset must be finite");
  }
  return model;
}

void bind_robots(py::module_& module) {
  bind_parts(module);
  bind_model(module);
}

}  // namespace seam::python
