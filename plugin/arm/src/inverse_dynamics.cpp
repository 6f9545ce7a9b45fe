#include <algorithm>
#include <cassert>

#include <BulletInverseDynamics/MultiBodyTree.hpp>

#include "bullet_types.hpp"
#include <seam/error.hpp>
#include <seam/inverse_dynamics.hpp>

namespace seam {

namespace id = btInverseDynamics;

namespace {

id::JointType tree_type(const Joint& joint) {
  return joint.type == Joint::Type::prismatic ? id::PRISMATIC : id::REVOLUTE;
}

void require(int status, const std::string& body) {
  if (status != 0) throw Error("body \"" + body + "\"", "Bullet's inverse dynamics refuses it");
}

/// The tree's root: a base with one joint may be left out, which saves a body in every call.
bool needs_root(const RobotModel& model) {
  return std::count_if(model.joints.begin(), model.joints.end(),
                       [](const Joint& joint) { return joint.parent < 0; }) != 1;
}

}  // namespace

struct InverseDynamics::Tree {
  explicit Tree(const RobotModel& model);
  void add(const Joint& joint, const Body& body);

  id::MultiBodyTree bodies;
  int count = 0;  // of the bodies added
  int root;       // 1: body 0 is the base
  id::vecx q, qd, qdd, torque;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

InverseDynamics::Tree::Tree(const RobotModel& model)
    : root(needs_root(model) ? 1 : 0),
      q(model.dof()),
      qd(model.dof()),
      qdd(model.dof()),
      torque(model.dof()) {
  require_one_precision();
  const id::vec3 zero(btVector3(0, 0, 0));
  const id::mat33 one(btMatrix3x3::getIdentity());
  if (root == 1) {
    require(bodies.addBody(count++, -1, id::FIXED, zero, one, zero, 0, zero, one, 0, nullptr),
            model.base.link);
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) add(model.joints[i], model.bodies[i]);
  require(bodies.finalize(), model.base.link);
  // Given here and not in addBody, whose checks are exact where a flat body's rounded inertia is
  // not.
  for (int i = 0; i < model.dof(); ++i) {
    const Inertial& inertial = model.bodies[static_cast<std::size_t>(i)].inertial;
    bodies.setBodySecondMassMoment(i + root, bullet_matrix(inertial.about_origin()));
  }
}

void InverseDynamics::Tree::add(const Joint& joint, const Body& body) {
  const btQuaternion R_body_parent = bullet_rotation(joint.X_parent_body.linear().transpose());
  require(joint.parent + root < count ? 0 : -1, body.link);
  require(bodies.addBody(count, joint.parent + root, tree_type(joint),
                         bullet_vector(joint.X_parent_body.translation()),
                         btMatrix3x3(R_body_parent), bullet_vector(joint.axis.normalized()),
                         static_cast<btScalar>(body.inertial.mass),
                         bullet_vector(body.inertial.com), btMatrix3x3::getIdentity(), 0, nullptr),
          body.link);
  ++count;
}

InverseDynamics::InverseDynamics(const RobotModel& model) : tree_(std::make_unique<Tree>(model)) {
  set_gravity({0.0, 0.0, -9.81});
}
InverseDynamics::InverseDynamics(InverseDynamics&&) noexcept = default;
InverseDynamics& InverseDynamics::operator=(InverseDynamics&&) noexcept = default;
InverseDynamics::~InverseDynamics() = default;

int InverseDynamics::dof() const noexcept {
  return tree_->q.size();
}

void InverseDynamics::set_gravity(const Eigen::Vector3d& gravity_in_base) noexcept {
  if (gravity_in_base == tree_->gravity) return;
  tree_->gravity = gravity_in_base;
  tree_->bodies.setGravityInWorldFrame(bullet_vector(gravity_in_base));
}

void InverseDynamics::torque(const Eigen::Ref<const Eigen::VectorXd>& q,
                             const Eigen::Ref<const Eigen::VectorXd>& qd,
                             const Eigen::Ref<const Eigen::VectorXd>& qdd,
                             Eigen::Ref<Eigen::VectorXd> torque) const noexcept {
  Tree& tree = *tree_;
  const int n = dof();
  assert(q.size() == n && qd.size() == n && qdd.size() == n && torque.size() == n);
  for (int i = 0; i < n; ++i) {
    tree.q(i) = static_cast<btScalar>(q[i]);
    tree.qd(i) = static_cast<btScalar>(qd[i]);
    tree.qdd(i) = static_cast<btScalar>(qdd[i]);
  }
  tree.bodies.calculateInverseDynamics(tree.q, tree.qd, tree.qdd, &tree.torque);
  for (int i = 0; i < n; ++i) torque[i] = tree.torque(i);
}

}  // namespace seam
