#include <algorithm>

#include <BulletDynamics/Featherstone/btMultiBody.h>

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
  robot.state(q, qd);
  return q;
}

// Moves nothing: see apply_torque.
constexpr double mark = 0.1234567890123;  // [N·m]

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
      applied_(q_),
      arm_(known(robot.model(), settings.model), sequence, join, settings, look(robot, q_, qd_),
           qd_) {}

Controller::~Controller() {
  if (plugin_) plugin_->remove(*this);
}

bool Controller::reinitialise() noexcept {
  robot_.state(q_, qd_);
  return arm_.reinitialise(q_, qd_);
}

void Controller::pre_tick(double dt) noexcept {
  if (!(dt > 0.0)) return;
  robot_.state(q_, qd_);
  arm_.set_gravity(robot_.gravity_in_base());
  apply_torque(arm_.tick(dt, q_, qd_));
}

// Bullet clears joint torques once per stepSimulation and not per substep. The base of a fixed-base
// multibody bears a torque that moves nothing and is cleared with them: if it is still what we left,
// our joint torques still stand too.
void Controller::apply_torque(const Eigen::VectorXd& torque) noexcept {
  btMultiBody& multibody = robot_.multibody();
  const bool still_stands = marked_ && multibody.getBaseTorque().x() == base_torque_;
  for (int i = 0; i < torque.size(); ++i) {
    const double applied = still_stands ? applied_(i) : 0.0;
    multibody.getLink(i).m_jointTorque[0] += static_cast<btScalar>(torque(i) - applied);
    applied_(i) = torque(i);
  }
  if (!still_stands) multibody.addBaseTorque(btVector3(btScalar(mark), 0, 0));
  base_torque_ = multibody.getBaseTorque().x();
  marked_ = true;
}

}  // namespace seam
