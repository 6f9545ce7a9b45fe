#include "multibody.hpp"

#include <Eigen/Eigenvalues>

#include "bullet_types.hpp"

namespace seam {
namespace {

/// What Bullet's set-up calls ask for, in Bullet's frames.
struct Link {
  btQuaternion R_link_parent;  // turns vectors of the parent's link frame into this one's
  btVector3 axis;              // in this link's frame
  btVector3 parent_to_pivot;   // from the parent's frame to the joint, in the parent's frame
  btVector3 pivot_to_link;     // from the joint to this frame, in this frame
};

Link link_in_bullet(const Joint& joint, const Eigen::Isometry3d& X_parent_plink,
                    const Eigen::Isometry3d& X_body_link) {
  const Eigen::Isometry3d X_plink_body = X_parent_plink.inverse() * joint.X_parent_body;
  const Eigen::Matrix3d R_plink_link = X_plink_body.linear() * X_body_link.linear();
  const Eigen::Matrix3d R_link_body = X_body_link.linear().transpose();
  return {bullet_rotation(R_plink_link.transpose()),
          bullet_vector((R_link_body * joint.axis).normalized()),
          bullet_vector(X_plink_body.translation()),
          bullet_vector(R_link_body * X_body_link.translation())};
}

void set_up_link(btMultiBody& multibody, int i, const Joint& joint, const Link& link, double mass,
                 const Eigen::Vector3d& inertia) {
  constexpr bool parent_does_not_collide = true;
  const auto set_up = joint.type == Joint::Type::prismatic ? &btMultiBody::setupPrismatic
                                                           : &btMultiBody::setupRevolute;
  (multibody.*set_up)(i, static_cast<btScalar>(mass), bullet_vector(inertia), joint.parent,
                      link.R_link_parent, link.axis, link.parent_to_pivot, link.pivot_to_link,
                      parent_does_not_collide);
}

void describe_link(btMultibodyLink& link, const Joint& joint, const Body& body) {
  link.m_linkName = body.link.c_str();
  link.m_jointName = joint.name.c_str();
  link.m_jointLowerLimit = static_cast<btScalar>(joint.lower);
  link.m_jointUpperLimit = static_cast<btScalar>(joint.upper);
  link.m_jointMaxVelocity = static_cast<btScalar>(joint.speed);
  link.m_jointMaxForce = static_cast<btScalar>(joint.effort);
}

}  // namespace

LinkFrame link_frame(const Inertial& inertial) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertial.inertia);
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  LinkFrame frame;
  frame.X_body_link.linear() = axes;
  frame.X_body_link.translation() = inertial.com;
  frame.inertia = principal.eigenvalues();
  return frame;
}

std::unique_ptr<btMultiBody> make_multibody(const RobotModel& model,
                                            const std::vector<LinkFrame>& frames) {
  constexpr bool fixed_base = true;
  constexpr bool can_sleep = false;
  auto multibody = std::make_unique<btMultiBody>(model.dof(), btScalar(0), btVector3(0, 0, 0),
                                                 fixed_base, can_sleep);
  multibody->setBaseName(model.base.link.c_str());
  multibody->setLinearDamping(0);
  multibody->setAngularDamping(0);
  for (int i = 0; i < model.dof(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Joint& joint = model.joints[k];
    const Eigen::Isometry3d X_parent_plink =
        joint.parent < 0 ? Eigen::Isometry3d::Identity()
                         : frames[static_cast<std::size_t>(joint.parent)].X_body_link;
    const Link link = link_in_bullet(joint, X_parent_plink, frames[k].X_body_link);
    set_up_link(*multibody, i, joint, link, model.bodies[k].inertial.mass, frames[k].inertia);
    describe_link(multibody->getLink(i), joint, model.bodies[k]);
  }
  multibody->finalizeMultiDof();
  const Eigen::VectorXd q = model.neutral();
  for (int i = 0; i < model.dof(); ++i) multibody->setJointPos(i, static_cast<btScalar>(q(i)));
  return multibody;
}

}  // namespace seam
