#include "scenes/friction.hpp"

#include <vector>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>

#include "plugin/arm/src/settings_check.hpp"

namespace seam {

struct Friction::Parts {
  Robot& robot;
  Eigen::VectorXd viscous, coulomb;
  std::vector<std::unique_ptr<btMultiBodyJointMotor>> motors;  // of the joints with Coulomb's
  std::vector<Eigen::Index> joints;                            // of each motor
};

Friction::Friction(Robot& robot, int joints, const FrictionSettings& settings)
    : parts_(new Parts{robot,
                       not_negative("friction: viscous", settings.viscous, joints),
                       not_negative("friction: coulomb", settings.coulomb, joints),
                       {},
                       {}}) {
  for (int i = 0; i < joints; ++i) {
    if (parts_->coulomb(i) == 0.0) continue;
    if (!robot.multibody().getLinkCollider(i))
      throw Error(
          "friction: joint \"" + robot.model().joints[static_cast<std::size_t>(i)].name + "\"",
          "its link has no collision shape, which Coulomb friction needs in Bullet");
    parts_->joints.push_back(i);
    auto& motor = parts_->motors.emplace_back(
        std::make_unique<btMultiBodyJointMotor>(&robot.multibody(), i, 0.0, 0.0));
    motor->finalizeMultiDof();
    robot.world().addMultiBodyConstraint(motor.get());
  }
}

Friction::~Friction() {
  for (const auto& motor : parts_->motors)
    parts_->robot.world().removeMultiBodyConstraint(motor.get());
}

void Friction::pre_tick(double dt) noexcept {
  btMultiBody& multibody = parts_->robot.multibody();
  for (int i = 0; i < parts_->viscous.size(); ++i)
    multibody.addJointTorque(i, -parts_->viscous(i) * multibody.getJointVel(i));
  for (std::size_t i = 0; i < parts_->motors.size(); ++i)
    parts_->motors[i]->setMaxAppliedImpulse(parts_->coulomb(parts_->joints[i]) * dt);
}

}  // namespace seam
