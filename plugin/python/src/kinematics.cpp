// Where a tool is, and where the joints must be for it.
#include <memory>

#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/parts.hpp"
#include "plugin/python/src/states.hpp"
#include <seam/inverse_kinematics.hpp>
#include <seam/joint_reference.hpp>
#include <seam/kinematics.hpp>

namespace seam::python {

namespace {

void bind_forward(py::module_& module) {
  Class<Kinematics> kinematics(module, "Kinematics");
  kinematics
      .init(
          [](const RobotModel& model, const std::string& link,
             const Eigen::Isometry3d& X_link_tool) {
            Kinematics made(sound(model), link, X_link_tool);
            made.move_to(model.neutral());
            return made;
          },
          py::arg("model"), py::arg("link"),
          py::arg_v("X_link_tool", Eigen::Isometry3d(Eigen::Isometry3d::Identity()),
                    "numpy.eye(4)"))
      .property("dof", &Kinematics::dof)
      .def(
          "pose_at",
          [](const Kinematics& self, const Numbers& q) {
            return self.pose_at(q.vector("q", self.dof()));
          },
          py::arg("q"))
      .def(
          "move_to",
          [](Kinematics& self, const Numbers& q) { self.move_to(q.vector("q", self.dof())); },
          py::arg("q"))
      .property("X_base_tool",
                [](const Kinematics& self) { return Eigen::Isometry3d(self.X_base_tool()); })
      .property("jacobian", [](const Kinematics& self) { return Eigen::MatrixXd(self.jacobian()); })
      .def(
          "wrench_gradient",
          [](const Kinematics& self, const Numbers& wrench) {
            Eigen::MatrixXd gradient(self.dof(), self.dof());
            self.wrench_gradient(wrench.vector("wrench", 6), gradient);
            return gradient;
          },
          py::arg("wrench"));
  Class<Kinematics::MovingWrench>(*kinematics, "MovingWrench", "Kinematics::MovingWrench")
      .field("value", &Kinematics::MovingWrench::value)
      .field("rate", &Kinematics::MovingWrench::rate)
      .made_of_fields();
  (*kinematics)
      .def(
          "move_on",
          [](const Kinematics& self, const Numbers& qd, const Kinematics::MovingWrench& wrench) {
            Eigen::VectorXd curvature(self.dof());
            const Vector6d acceleration =
                self.move_on(qd.vector("qd", self.dof()), wrench, curvature);
            return std::pair(acceleration, curvature);
          },
          (std::string(doc("Kinematics::move_on")) +
           "\n\nIn Python: gives (acceleration, curvature).")
              .c_str(),
          py::arg("qd"), py::arg("wrench"));
}

void bind_inverse(py::module_& module) {
  Class<ToolState>(module, "ToolState")
      .field("pose", &ToolState::pose)
      .field("velocity", &ToolState::velocity)
      .field("acceleration", &ToolState::acceleration)
      .made_of_fields();
  Class<JointSolution>(module, "JointSolution")
      .field("position", &JointSolution::position)
      .field("velocity", &JointSolution::velocity)
      .field("acceleration", &JointSolution::acceleration)
      .field("position_error", &JointSolution::position_error)
      .field("angle_error", &JointSolution::angle_error)
      .made_of_fields();
  Class<PostureSettings>(module, "PostureSettings")
      .field("rest", &PostureSettings::rest)
      .field("weight", &PostureSettings::weight)
      .field("damped_below", &PostureSettings::damped_below)
      .field("damping", &PostureSettings::damping)
      .field("most_error", &PostureSettings::most_error)
      .made_of_fields();
  Class<InverseKinematics> inverse(module, "InverseKinematics");
  using Status = InverseKinematics::Status;
  Enum<Status>(*inverse, "Status", "InverseKinematics::Status")
      .value("exact", Status::exact)
      .value("damped", Status::damped)
      .value("beyond_limit", Status::beyond_limit)
      .value("lost", Status::lost);
  inverse
      .init(
          [](const RobotModel& model, const Kinematics& kinematics,
             const PostureSettings& posture) {
            if (kinematics.dof() != model.dof())
              throw Error("kinematics", "of " + std::to_string(kinematics.dof()) +
                                            " joints, the model has " +
                                            std::to_string(model.dof()));
            InverseKinematics made(sound(model), kinematics, posture);
            made.start(model.neutral());
            return made;
          },
          py::arg("model"), py::arg("kinematics"),
          py::arg_v("posture", PostureSettings{}, "PostureSettings()"))
      .property("dof", &InverseKinematics::dof)
      .def("reach", &InverseKinematics::reach, py::arg("pose"))
      .def(
          "start",
          [](InverseKinematics& self, const Numbers& q) { self.start(q.vector("q", self.dof())); },
          py::arg("q"));
  (*inverse).def(
      "follow",
      [](InverseKinematics& self, const ToolState& target) {
        JointSolution solution;
        solution.position = solution.velocity = solution.acceleration =
            Eigen::VectorXd::Zero(self.dof());
        const Status status = self.follow(target, solution);
        const bool found = status == Status::exact || status == Status::damped;
        return std::pair(status, found ? std::optional(solution) : std::nullopt);
      },
      "(status, solution) for the tool's next state, from where it was last; the solution is None "
      "unless the status is exact or damped.",
      py::arg("target"));
}

// A reference, and of how many joints and coordinates.
template <typename Reference>
struct Sized {
  std::unique_ptr<Reference> reference;
  int joints, coordinates;
};

template <typename Reference>
void bind_reference(Class<Sized<Reference>>& bound) {
  using S = Sized<Reference>;
  const auto said = [](const char* name) { return doc(std::string("JointReference::") + name); };
  (*bound)
      .def(
          "measured",
          [](S& self, const Numbers& q, const Numbers& qd) {
            return self.reference->measured(q.vector("q", self.joints),
                                            qd.vector("qd", self.joints));
          },
          said("measured"), py::arg("q"), py::arg("qd"))
      .def(
          "take_up",
          [](S& self, const Numbers& q, const Numbers& qd) {
            Sample at(self.coordinates);
            const bool there = self.reference->take_up(q.vector("q", self.joints),
                                                       qd.vector("qd", self.joints), at);
            return there ? std::optional(at) : std::nullopt;
          },
          "The state of the sequence's coordinates while the joints are at (q, qd): a Sample, or "
          "None where they have no such state.",
          py::arg("q"), py::arg("qd"))
      .def(
          "at_goal",
          [](S& self, const Numbers& goal) {
            Eigen::VectorXd joints = Eigen::VectorXd::Zero(self.joints);
            const bool known =
                self.reference->at_goal(goal.vector("goal", self.coordinates), joints);
            return known ? std::optional(joints) : std::nullopt;
          },
          "Joint positions (n,) [rad or m] at a goal of the sequence, or None where only moving "
          "there tells.",
          py::arg("goal"))
      .def(
          "require_reachable",
          [](S& self, const Primitive& primitive) {
            primitive.validate();
            if (primitive.dimensions() != self.coordinates)
              throw Error("primitive", "has " + std::to_string(primitive.dimensions()) +
                                           " coordinates, must have " +
                                           std::to_string(self.coordinates));
            self.reference->require_reachable(primitive);
          },
          said("require_reachable"), py::arg("primitive"))
      .def(
          "find",
          [](S& self, const Start& sample) {
            Sample joints(self.joints);
            const bool found = self.reference->find(sample.of(self.coordinates, "sample"), joints);
            return found ? std::optional(joints) : std::nullopt;
          },
          "The joints' state for a sample of the sequence: a Sample of n joints, or None where "
          "there is none.",
          py::arg("sample"))
      .def(
          "miss",
          [](S& self, const Start& sample, const Numbers& q) {
            return self.reference->miss(sample.of(self.coordinates, "sample"),
                                        q.vector("q", self.joints));
          },
          said("miss"), py::arg("sample"), py::arg("q"));
}

void bind_spaces(py::module_& module) {
  Class<ToolError>(module, "ToolError")
      .field("distance", &ToolError::distance)
      .field("angle", &ToolError::angle)
      .made_of_fields();
  Class<ToolSettings>(module, "ToolSettings")
      .field("link", &ToolSettings::link)
      .field("X_link_tool", &ToolSettings::X_link_tool)
      .field("orientation", &ToolSettings::orientation)
      .field("posture", &ToolSettings::posture)
      .field("most_speed", &ToolSettings::most_speed)
      .made_of_fields();

  using Joints = Sized<JointSpace>;
  Class<Joints> joints(module, "JointSpace", "JointSpace");
  joints.init(
      [](const RobotModel& robot, const std::vector<std::string>& coordinates) {
        return Joints{std::make_unique<JointSpace>(robot, coordinates), robot.dof(),
                      static_cast<int>(coordinates.size())};
      },
      py::arg("robot"), py::arg("coordinates"));
  bind_reference(joints);

  using Tool = Sized<TaskSpace>;
  Class<Tool> tool(module, "TaskSpace", "TaskSpace");
  tool.init(
          [](const RobotModel& robot, const Sequence& sequence, const ToolSettings& settings,
             const Numbers& q) {
            return Tool{
                std::make_unique<TaskSpace>(robot, sequence, settings, q.vector("q", robot.dof())),
                robot.dof(), static_cast<int>(sequence.coordinates().size())};
          },
          py::arg("robot"), py::arg("sequence"), py::arg("tool"), py::arg("q"))
      .def(
          "reach",
          [](Tool& self, const Eigen::Isometry3d& pose) { return self.reference->reach(pose); },
          py::arg("pose"))
      .def(
          "pose",
          [](const Tool& self, const Numbers& position) {
            return self.reference->pose(position.vector("position", self.coordinates));
          },
          py::arg("position"))
      .def(
          "tool_at",
          [](const Tool& self, const Numbers& q) {
            return self.reference->tool_at(q.vector("q", self.joints));
          },
          py::arg("q"));
  bind_reference(tool);
}

}  // namespace

void bind_kinematics(py::module_& module) {
  bind_forward(module);
  bind_inverse(module);
  bind_spaces(module);
}

}  // namespace seam::python
