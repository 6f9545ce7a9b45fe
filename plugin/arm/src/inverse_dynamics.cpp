#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

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

/// All of a model that a tree is made of.
std::vector<double> numbers_of(const RobotModel& model) {
  std::vector<double> numbers;
  const auto add = [&](const auto& values) {
    numbers.insert(numbers.end(), values.data(), values.data() + values.size());
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const Inertial& inertial = model.bodies[i].inertial;
    numbers.insert(numbers.end(), {static_cast<double>(joint.parent),
                                   static_cast<double>(joint.type), inertial.mass});
    add(joint.X_parent_body.matrix());
    add(joint.axis);
    add(inertial.com);
    add(inertial.inertia);
  }
  return numbers;
}

}  // namespace

struct InverseDynamics::Tree {
  explicit Tree(const RobotModel& model);
  static std::shared_ptr<Tree> shared(const RobotModel& model);
  void add(const Joint& joint, const Body& body);

  id::MultiBodyTree bodies;
  int count = 0;  // of the bodies added
  int root;       // 1: body 0 is the base
  id::vecx q, qd, qdd, torque;
  Eigen::Vector3d gravity =
      Eigen::Vector3d::Constant(NAN);  // that was set last: Bullet begins with its own
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

// What this thread has made a tree of, and the tree, while one of its users is left.
std::shared_ptr<InverseDynamics::Tree> InverseDynamics::Tree::shared(const RobotModel& model) {
  struct Known {
    std::vector<double> numbers;
    std::weak_ptr<Tree> tree;
  };
  thread_local std::vector<Known> all;
  std::vector<double> numbers = numbers_of(model);
  for (const Known& known : all)
    if (known.numbers == numbers)
      if (std::shared_ptr<Tree> tree = known.tree.lock()) return tree;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const Known& known) { return known.tree.expired(); }),
            all.end());
  auto tree = std::make_shared<Tree>(model);
  all.push_back({std::move(numbers), tree});
  return tree;
}

InverseDynamics::InverseDynamics(const RobotModel& model)
    : shared_(Tree::shared(model)),
      made_by_(std::this_thread::get_id()),
      own_(std::make_unique<Tree>(model)),
      dof_(model.dof()) {}
InverseDynamics::InverseDynamics(InverseDynamics&&) noexcept = default;
InverseDynamics& InverseDynamics::operator=(InverseDynamics&&) noexcept = default;
InverseDynamics::~InverseDynamics() = default;

InverseDynamics::Tree& InverseDynamics::tree() const noexcept {
  return std::this_thread::get_id() == made_by_ ? *shared_ : *own_;
}

void InverseDynamics::torque(const Eigen::Ref<const Eigen::VectorXd>& q,
                             const Eigen::Ref<const Eigen::VectorXd>& qd,
                             const Eigen::Ref<const Eigen::VectorXd>& qdd,
                             Eigen::Ref<Eigen::VectorXd> torque) const noexcept {
  Tree& tree = this->tree();
  const int n = dof();
  assert(q.size() == n && qd.size() == n && qdd.size() == n && torque.size() == n);
  for (int i = 0; i < n; ++i) {
    tree.q(i) = static_cast<btScalar>(q[i]);
    tree.qd(i) = static_cast<btScalar>(qd[i]);
    tree.qdd(i) = static_cast<btScalar>(qdd[i]);
  }
  if (gravity_ != tree.gravity) {
    tree.gravity = gravity_;
    tree.bodies.setGravityInWorldFrame(bullet_vector(gravity_));
  }
  tree.bodies.calculateInverseDynamics(tree.q, tree.qd, tree.qdd, &tree.torque);
  for (int i = 0; i < n; ++i) torque[i] = tree.torque(i);
}

}  // namespace seam
