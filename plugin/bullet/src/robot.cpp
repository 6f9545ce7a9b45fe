#include <cassert>
#include <cmath>
#include <optional>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "bullet_types.hpp"
#include "drive_train.hpp"
#include "link_collider.hpp"
#include "multibody.hpp"
#include "shapes.hpp"
#include "text.hpp"
#include "world_watch.hpp"
#include <seam/error.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/robot.hpp>

namespace seam {

namespace {

constexpr int base_dof =
    6;  // that a multibody's velocity vector begins with, also where the base is fixed

constexpr double mark =
    0.1234567890123;  // [N·m] on the base, which moves nothing: see Robot::drive

// Bullet takes an inertia below its precision's for none, and does not move the joint.
void warn_of_small_inertia(RobotModel& model) {
  const Eigen::VectorXd moved = model.moved_inertia(model.neutral());
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const double inertia = moved(static_cast<Eigen::Index>(i));
    if (inertia >= SIMD_EPSILON) continue;
    const Joint& joint = model.joints[i];
    const char* const unit = joint.type == Joint::Type::prismatic ? " kg" : " kg m^2";
    model.warnings.emplace_back(
        Error("joint \"" + joint.name + "\"",
              text("moves an inertia of ", inertia, unit, ", must be >= ", SIMD_EPSILON,
                   " in this precision: Bullet does not move it"))
            .what());
  }
}

void require_tolerance(double tolerance) {
  if (!(std::isfinite(tolerance) && tolerance >= 0.0))
    throw Error("hull_tolerance", text(tolerance, " m, must be finite and >= 0"));
}

}  // namespace

struct Robot::Parts {
  Parts(RobotModel robot_model, btMultiBodyDynamicsWorld& in_world, const RobotSettings& settings);
  ~Parts();
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void add_collider(int link, const Body& body, const LinkFrame& frame,
                    const RobotSettings& settings);
  void find_what_never_meets();
  void add_to_world();
  void place_colliders();
  void rest_drives(const Eigen::Vector3d& gravity);
  void give(int joint, double given);
  void transmit(double dt, const Eigen::VectorXd& given) noexcept;

  RobotModel model;
  btMultiBodyDynamicsWorld& world;
  std::vector<LinkFrame> frames;
  std::vector<BodyShape> shapes;
  std::unique_ptr<btMultiBody> multibody;
  std::vector<std::unique_ptr<LinkCollider>> colliders;
  btAlignedObjectArray<btQuaternion> rotations;  // workspaces of place_colliders
  btAlignedObjectArray<btVector3> origins;
  std::optional<WorldWatch> watch;
  std::optional<DriveTrain> drives;
  bool sees_motors;          // the encoders do
  Eigen::VectorXd torque;    // n, of the drives, and what of it reaches the bodies
  Eigen::VectorXd applied;   // n, that of ours which still stands in the multibody
  btScalar base_torque = 0;  // on the base, as we left it
  bool marked = false;
  std::shared_ptr<bool> controlled = std::make_shared<bool>(false);
};

Robot::Parts::Parts(RobotModel robot_model, btMultiBodyDynamicsWorld& in_world,
                    const RobotSettings& settings)
    : model(std::move(robot_model)),
      world(in_world),
      sees_motors(settings.encoders == RobotSettings::Encoders::motor),
      torque(Eigen::VectorXd::Zero(model.dof())),
      applied(torque) {
  require_one_precision();
  require_tolerance(settings.hull_tolerance);
  warn_of_small_inertia(model);
  for (const Body& body : model.bodies) frames.push_back(link_frame(body.inertial));
  multibody = make_multibody(model, frames);
  multibody->setHasSelfCollision(settings.self_collision);
  multibody->setBaseWorldTransform(bullet_pose(settings.X_world_base));
  if (settings.colliders) {
    add_collider(-1, model.base, LinkFrame(), settings);
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      add_collider(static_cast<int>(i), model.bodies[i], frames[i], settings);
    }
    if (settings.self_collision) find_what_never_meets();
  }
  drives.emplace(settings.joint_dynamics ? model : RobotModel(), *multibody);
  add_to_world();
}

Robot::Parts::~Parts() {
  if (!watch->world_is_there()) return;
  world.removeMultiBody(multibody.get());
  for (const auto& collider : colliders) world.removeCollisionObject(collider.get());
}

void Robot::Parts::add_collider(int link, const Body& body, const LinkFrame& frame,
                                const RobotSettings& settings) {
  if (body.collisions.empty()) return;
  shapes.push_back(make_shape(body.collisions, frame.X_body_link, settings.hull_tolerance));
  colliders.push_back(std::make_unique<LinkCollider>(model, *multibody, link, world));
  LinkCollider& collider = *colliders.back();
  collider.setCollisionShape(shapes.back().compound.get());
  collider.setFriction(static_cast<btScalar>(settings.friction));
  if (link < 0) {
    multibody->setBaseCollider(&collider);
  } else {
    multibody->getLink(link).m_collider = &collider;
  }
}

void Robot::Parts::find_what_never_meets() {
  std::vector<CollidingBody> bodies;
  for (std::size_t k = 0; k < colliders.size(); ++k) {
    const int link = colliders[k]->m_link;
    const LinkFrame frame = link < 0 ? LinkFrame() : frames[static_cast<std::size_t>(link)];
    bodies.push_back({link, &shapes[k], frame.X_body_link});
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const auto joints = two_joints_between(model, bodies[a].link, bodies[b].link);
      if (!joints || !never_meet(model, bodies[a], bodies[b], *joints)) continue;
      colliders[a]->never_meets(*colliders[b], *joints);
      colliders[b]->never_meets(*colliders[a], *joints);
    }
  }
}

void Robot::Parts::add_to_world() {
  world.addMultiBody(multibody.get());
  place_colliders();
  using Filter = btBroadphaseProxy;
  for (const auto& collider : colliders) {
    const bool is_base = collider->m_link < 0;
    world.addCollisionObject(
        collider.get(), is_base ? Filter::StaticFilter : Filter::DefaultFilter,
        is_base ? Filter::AllFilter ^ Filter::StaticFilter : Filter::AllFilter);
  }
  watch.emplace(world);
}

void Robot::Parts::place_colliders() {
  multibody->forwardKinematics(rotations, origins);
  multibody->updateCollisionObjectWorldTransforms(rotations, origins);
  for (const auto& collider : colliders) {
    if (collider->getBroadphaseHandle()) world.updateSingleAabb(collider.get());
  }
}

// With springs that bear what holds the arm up.
void Robot::Parts::rest_drives(const Eigen::Vector3d& gravity) {
  Eigen::VectorXd holding = Eigen::VectorXd::Zero(model.dof());
  if (model.is_elastic()) {
    const Eigen::VectorXd rest = holding;
    Eigen::VectorXd q = holding;
    for (int i = 0; i < model.dof(); ++i) q(i) = multibody->getJointPos(i);
    InverseDynamics dynamics(model);
    dynamics.set_gravity(gravity);
    dynamics.torque(q, rest, rest, holding);
  }
  drives->reset(holding);
}

// What a drive gives its joint, instead of what stands of it.
void Robot::Parts::give(int joint, double given) {
  multibody->getLink(joint).m_jointTorque[0] += static_cast<btScalar>(given - applied(joint));
  applied(joint) = given;
}

// All other torques stand in the multibody when those of the joints with rotors, friction or springs are found.
void Robot::Parts::transmit(double dt, const Eigen::VectorXd& given) noexcept {
  torque << given, Eigen::VectorXd::Zero(model.dof() - given.size());
  for (int i = 0; i < model.dof(); ++i) give(i, torque(i));
  for (const int i : drives->joints()) give(i, 0.0);
  drives->transmit(dt, torque);
  for (const int i : drives->joints()) give(i, torque(i));
}

Robot Robot::load(const std::string& urdf_path, btMultiBodyDynamicsWorld& world,
                  const RobotSettings& settings) {
  return Robot(RobotModel::read(urdf_path, settings.urdf), world, settings);
}

Robot::Robot(RobotModel model, btMultiBodyDynamicsWorld& world, const RobotSettings& settings)
    : parts_(std::make_unique<Parts>(std::move(model), world, settings)) {
  parts_->rest_drives(gravity_in_base());
}
Robot::Robot(Robot&&) noexcept = default;
Robot& Robot::operator=(Robot&&) noexcept = default;
Robot::~Robot() = default;

const std::shared_ptr<bool>& Robot::controlled() const noexcept {
  return parts_->controlled;
}

const RobotModel& Robot::model() const noexcept {
  return parts_->model;
}
btMultiBody& Robot::multibody() noexcept {
  return *parts_->multibody;
}
const btMultiBody& Robot::multibody() const noexcept {
  return *parts_->multibody;
}
btMultiBodyDynamicsWorld& Robot::world() const noexcept {
  return parts_->world;
}

void Robot::state(Eigen::Ref<Eigen::VectorXd> q, Eigen::Ref<Eigen::VectorXd> qd) const noexcept {
  assert(q.size() <= dof() && qd.size() == q.size());
  const btMultiBody& robot = multibody();
  const btScalar* velocity = robot.getVelocityVector() + base_dof;
  for (int i = 0; i < q.size(); ++i) {
    q[i] = robot.getLink(i).m_jointPos[0];
    qd[i] = velocity[i];
  }
}

void Robot::motor_state(Eigen::Ref<Eigen::VectorXd> q,
                        Eigen::Ref<Eigen::VectorXd> qd) const noexcept {
  state(q, qd);
  parts_->drives->state_of_drives(q, qd);
}

void Robot::measured_state(Eigen::Ref<Eigen::VectorXd> q,
                           Eigen::Ref<Eigen::VectorXd> qd) const noexcept {
  parts_->sees_motors ? motor_state(q, qd) : state(q, qd);
}

// Bullet clears joint torques once per stepSimulation and not per substep. The base of a fixed-base
// multibody bears a torque that moves nothing and is cleared with them: if it is still what we left,
// our joint torques still stand too.
void Robot::drive(double dt, const Eigen::VectorXd& torque) noexcept {
  assert(torque.size() <= dof());
  btMultiBody& robot = multibody();
  Parts& parts = *parts_;
  const bool still_stands = parts.marked && robot.getBaseTorque().x() == parts.base_torque;
  if (!still_stands) parts.applied.setZero();
  if (parts.drives->is_there())
    parts.transmit(dt, torque);
  else
    for (int i = 0; i < torque.size(); ++i) parts.give(i, torque(i));
  if (!still_stands) robot.addBaseTorque(btVector3(btScalar(mark), 0, 0));
  parts.base_torque = robot.getBaseTorque().x();
  parts.marked = true;
}

void Robot::reset(const Eigen::Ref<const Eigen::VectorXd>& q,
                  const Eigen::Ref<const Eigen::VectorXd>& qd) {
  assert(q.size() == dof() && qd.size() == dof());
  for (int i = 0; i < dof(); ++i) {
    multibody().setJointPos(i, static_cast<btScalar>(q[i]));
    multibody().setJointVel(i, static_cast<btScalar>(qd[i]));
  }
  parts_->place_colliders();
  parts_->rest_drives(gravity_in_base());
}

Eigen::Isometry3d Robot::X_world_base() const noexcept {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = eigen_rotation(multibody().getWorldToBaseRot()).transpose();
  X.translation() = eigen_vector(multibody().getBasePos());
  return X;
}

Eigen::Isometry3d Robot::X_world_frame(const Frame& frame) const noexcept {
  Eigen::Isometry3d X = frame.X_body_frame;
  for (int i = frame.body; i >= 0;) {
    const Joint& joint = model().joints[static_cast<std::size_t>(i)];
    X = joint.X_parent_body_at(multibody().getJointPos(i)) * X;
    i = joint.parent;
  }
  return X_world_base() * X;
}

Eigen::Vector3d Robot::gravity_in_base() const noexcept {
  const btQuaternion& R = multibody().getWorldToBaseRot();
  return Eigen::Quaterniond(R.w(), R.x(), R.y(), R.z()) * eigen_vector(world().getGravity());
}

}  // namespace seam
