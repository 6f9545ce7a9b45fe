#include <memory>
#include <string>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <seam/robot.hpp>

namespace py = pybind11;

namespace seam::test {

/// A Bullet world with robots for tests that stand in for PyBullet: it knows what moves, and nothing of links that are fixed to
/// others. Nothing collides within a robot.
class StandInWorld {
 public:
  /// @param quaternion  x, y, z, w of the root link
  int add(const std::string& urdf, const Eigen::Vector3d& position,
          const Eigen::Vector4d& quaternion) {
    RobotSettings settings;
    settings.X_world_base.translation() = position;
    settings.X_world_base.linear() = Eigen::Quaterniond(quaternion).toRotationMatrix();
    settings.urdf.leave_out_missing_meshes = true;
    settings.self_collision = false;
    settings.joint_dynamics = false;
    auto body = std::make_unique<Body>(Body{Robot::load(urdf, world_, settings), {}});
    bodies_.push_back(std::move(body));
    return static_cast<int>(bodies_.size()) - 1;
  }
  void remove(int body) {
    drop_motors(at(body));
    bodies_[static_cast<std::size_t>(body)].reset();
  }
  ~StandInWorld() {
    for (const auto& body : bodies_)
      if (body) drop_motors(*body);
  }

  std::vector<std::string> joints(int body) const {
    std::vector<std::string> names;
    for (const Joint& joint : at(body).robot.model().joints) names.push_back(joint.name);
    return names;
  }
  std::pair<Eigen::VectorXd, Eigen::VectorXd> state(int body) const {
    const Robot& robot = at(body).robot;
    Eigen::VectorXd q(robot.dof()), qd(robot.dof());
    robot.state(q, qd);
    return {q, qd};
  }
  void reset(int body, const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
    at(body).robot.reset(q, qd);
  }
  /// Lasts for one step.
  void add_torque(int body, int joint, double torque) {
    at(body).robot.multibody().addJointTorque(joint, torque);
  }
  /// Holds the joint with at most this impulse [N m s or N s] a step.
  void hold(int body, int joint, double impulse) {
    Body& held = at(body);
    held.motors.resize(static_cast<std::size_t>(held.robot.dof()));
    auto& motor = held.motors[static_cast<std::size_t>(joint)];
    if (!motor) {
      motor = std::make_unique<btMultiBodyJointMotor>(&held.robot.multibody(), joint, 0, 0.0, 1.0);
      motor->setVelocityTarget(0.0, 1.0);
      world_.addMultiBodyConstraint(motor.get());
      motor->finalizeMultiDof();
    }
    motor->setMaxAppliedImpulse(impulse);
  }
  void set_damping(int body, double linear, double angular) {
    at(body).robot.multibody().setLinearDamping(linear);
    at(body).robot.multibody().setAngularDamping(angular);
  }
  void set_gravity(const Eigen::Vector3d& gravity) {
    world_.setGravity({gravity.x(), gravity.y(), gravity.z()});
  }
  /// @param substeps  0: one step of dt
  void step(double dt, int substeps) {
    world_.stepSimulation(dt, substeps, substeps > 0 ? dt / substeps : dt);
  }

 private:
  struct Body {
    Robot robot;
    std::vector<std::unique_ptr<btMultiBodyJointMotor>> motors;
  };
  Body& at(int body) const { return *bodies_.at(static_cast<std::size_t>(body)); }
  void drop_motors(Body& body) {
    for (const auto& motor : body.motors)
      if (motor) world_.removeMultiBodyConstraint(motor.get());
    body.motors.clear();
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<Body>> bodies_;
};

}  // namespace seam::test

PYBIND11_MODULE(seam_test_world, module) {
  using seam::test::StandInWorld;
  py::class_<StandInWorld>(module, "World")
      .def(py::init<>())
      .def("add", &StandInWorld::add)
      .def("remove", &StandInWorld::remove)
      .def("joints", &StandInWorld::joints)
      .def("state", &StandInWorld::state)
      .def("reset", &StandInWorld::reset)
      .def("add_torque", &StandInWorld::add_torque)
      .def("hold", &StandInWorld::hold)
      .def("set_damping", &StandInWorld::set_damping)
      .def("set_gravity", &StandInWorld::set_gravity)
      .def("step", &StandInWorld::step);
}
