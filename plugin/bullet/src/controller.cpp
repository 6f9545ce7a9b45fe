#include <algorithm>

#include <seam/controller.hpp>
#include <seam/error.hpp>
#include <seam/plugin.hpp>

namespace seam {

namespace {

// What the controller takes the robot for.
const RobotModel& known(const RobotModel& all, const std::optional<RobotModel>& model) {
  if (!model) return all;
  const auto& joints = model->joints;
  const auto same = [](const Joint& a, const Joint& b) { return a.name == b.name; };
  if (joints.size() > all.joints.size() ||
      !std::equal(joints.begin(), joints.end(), all.joints.begin(), same))
    throw Error("controller", "the joints of its model are not the robot's first ones");
  return *model;
}

const Eigen::VectorXd& look(const Robot& robot, Eigen::VectorXd& q, Eigen::VectorXd& qd) {
  robot.measured_state(q, qd);
  return q;
}

}  // namespace

Controller::Claim::Claim(const Robot& robot) : controlled_(robot.controlled()) {
  if (*controlled_)
    throw Error(robot.model().name,
                "has a controller already, whose torques those of another would add to");
  *controlled_ = true;
}

Controller::Controller(Robot& robot, const Sequence& sequence, const JoinSettings& join,
                       const ControllerSettings& settings)
    : robot_(robot),
      claim_(robot),
      q_(Eigen::VectorXd::Zero(known(robot.model(), settings.model).dof())),
      qd_(q_),
      arm_(known(robot.model(), settings.model), sequence, join, settings, look(robot, q_, qd_),
           qd_) {}

Controller::~Controller() {
  if (plugin_) plugin_->remove(*this);
}

bool Controller::reinitialise() noexcept {
  robot_.measured_state(q_, qd_);
  return arm_.reinitialise(q_, qd_);
}

void Controller::pre_tick(double dt) noexcept {
  if (!(dt > 0.0)) return;
  robot_.measured_state(q_, qd_);
  arm_.set_gravity(robot_.gravity_in_base());
  robot_.drive(dt, arm_.tick(dt, q_, qd_));
}

}  // namespace seam
