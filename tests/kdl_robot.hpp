#pragma once

#include <map>
#include <memory>
#include <string>

#include <Eigen/Geometry>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <urdf_parser/urdf_parser.h>

/// The same robot in Orocos KDL, made from urdfdom's model alone: the opinion of another library.
/// Every URDF link is a segment of its own, nothing is merged.
class KdlRobot {
 public:
  explicit KdlRobot(const std::string& urdf_path) {
    const auto model = urdf::parseURDFFile(urdf_path);
    tree_ = KDL::Tree(model->getRoot()->name);
    add_children(*model->getRoot());
    for (const auto& [name, element] : tree_.getSegments()) {
      joint_index_[element.segment.getJoint().getName()] = element.q_nr;
    }
  }

  /// `names[i]` is the joint that coordinate i belongs to.
  template <typename Names>
  Eigen::VectorXd torque(const Names& names, const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                         const Eigen::VectorXd& qdd, const Eigen::Vector3d& gravity) const {
    KDL::TreeIdSolver_RNE solver(tree_, KDL::Vector(gravity.x(), gravity.y(), gravity.z()));
    KDL::JntArray torques(tree_.getNrOfJoints());
    solver.CartToJnt(sort(names, q), sort(names, qd), sort(names, qdd), {}, torques);
    Eigen::VectorXd result(q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) result[i] = torques(index(names, i));
    return result;
  }

  template <typename Names>
  Eigen::Isometry3d pose(const Names& names, const Eigen::VectorXd& q,
                         const std::string& link) const {
    KDL::Frame frame;
    KDL::TreeFkSolverPos_recursive(tree_).JntToCart(sort(names, q), frame, link);
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) X(row, column) = frame.M(row, column);
      X(row, 3) = frame.p[row];
    }
    return X;
  }

 private:
  static KDL::Vector vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }
  static KDL::Frame frame(const urdf::Pose& pose) {
    const urdf::Rotation& r = pose.rotation;
    return {KDL::Rotation::Quaternion(r.x, r.y, r.z, r.w), vector(pose.position)};
  }
  static KDL::RigidBodyInertia inertia(const urdf::Link& link) {
    if (!link.inertial) return KDL::RigidBodyInertia::Zero();
    const urdf::Inertial& i = *link.inertial;
    const KDL::RotationalInertia I(i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz);
    return frame(i.origin) * KDL::RigidBodyInertia(i.mass, KDL::Vector::Zero(), I);
  }
  static KDL::Joint joint(const urdf::Joint& j) {
    const KDL::Frame X = frame(j.parent_to_joint_origin_transform);
    if (j.type == urdf::Joint::FIXED) return KDL::Joint(j.name, KDL::Joint::Fixed);
    const auto type =
        j.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
    return {j.name, X.p, X.M * vector(j.axis), type};
  }

  void add_children(const urdf::Link& link) {
    for (const auto& child : link.child_links) {
      const urdf::Joint& j = *child->parent_joint;
      tree_.addSegment(KDL::Segment(child->name, joint(j),
                                    frame(j.parent_to_joint_origin_transform), inertia(*child)),
                       link.name);
      add_children(*child);
    }
  }

  template <typename Names>
  unsigned index(const Names& names, Eigen::Index i) const {
    return joint_index_.at(names[static_cast<std::size_t>(i)]);
  }
  template <typename Names>
  KDL::JntArray sort(const Names& names, const Eigen::VectorXd& values) const {
    KDL::JntArray sorted(tree_.getNrOfJoints());
    for (Eigen::Index i = 0; i < values.size(); ++i) sorted(index(names, i)) = values[i];
    return sorted;
  }

  KDL::Tree tree_;
  std::map<std::string, unsigned> joint_index_;
};
