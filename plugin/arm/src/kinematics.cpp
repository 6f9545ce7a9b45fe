#include <algorithm>
#include <cmath>

#include <seam/error.hpp>
#include <seam/kinematics.hpp>

namespace seam {

namespace {

// A rotation that takes z to an axis: exact where the axis is one of the frame's.
Eigen::Isometry3d turned_to(const Eigen::Vector3d& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d x = axis.cross(Eigen::Vector3d::Unit(least)).normalized();
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() << x, axis.cross(x), axis;
  return turned;
}

}  // namespace

Kinematics::Kinematics(const RobotModel& model, const std::string& link,
                       const Eigen::Isometry3d& X_link_tool)
    : X_last_tool_(model.frame(link).X_body_frame * X_link_tool) {
  for (int i = model.frame(link).body; i >= 0;
       i = model.joints[static_cast<std::size_t>(i)].parent) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    if (joint.follows())
      throw Error("link \"" + link + "\"", "is moved by joint \"" + joint.name +
                                               "\", which follows another; take a link before it");
    const Eigen::Isometry3d to_axis = turned_to(joint.axis);
    Eigen::Isometry3d& X_joint_next = chain_.empty() ? X_last_tool_ : chain_.back().X_before_joint;
    X_joint_next = to_axis.inverse() * X_joint_next;
    chain_.push_back({i, joint.type == Joint::Type::prismatic, joint.X_parent_body * to_axis});
  }
  if (chain_.empty()) throw Error("link \"" + link + "\"", "is moved by no joint");
  std::reverse(chain_.begin(), chain_.end());
  jacobian_.setZero(6, model.dof());
  move_to(Eigen::VectorXd::Zero(model.dof()));
}

// Along the chain to the frame; each joint is seen before it moves, its axis z.
template <typename Visit>
Eigen::Isometry3d Kinematics::walk(const Eigen::Ref<const Eigen::VectorXd>& q,
                                   Visit&& visit) const noexcept {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (const Link& link : chain_) {
    p += R * link.X_before_joint.translation();
    R = R * link.X_before_joint.linear();
    visit(link, R.col(2), p);
    if (link.prismatic) {
      p += q(link.joint) * R.col(2);
    } else {
      const double s = std::sin(q(link.joint));
      const double c = std::cos(q(link.joint));
      const Eigen::Vector3d x = R.col(0);
      R.col(0) = c * x + s * R.col(1);
      R.col(1) = c * R.col(1) - s * x;
    }
  }
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = p + R * X_last_tool_.translation();
  X.linear() = R * X_last_tool_.linear();
  return X;
}

Eigen::Isometry3d Kinematics::pose_at(const Eigen::Ref<const Eigen::VectorXd>& q) const noexcept {
  return walk(q, [](const auto&...) {});
}

void Kinematics::move_to(const Eigen::Ref<const Eigen::VectorXd>& q) noexcept {
  X_base_tool_ = walk(q, [&](const Link& link, const auto& axis, const Eigen::Vector3d& origin) {
    jacobian_.col(link.joint) << origin, axis;  // until the tool is known
  });
  const Eigen::Vector3d tool = X_base_tool_.translation();
  for (const Link& link : chain_) {
    auto column = jacobian_.col(link.joint);
    const Eigen::Vector3d axis = column.tail<3>();
    if (link.prismatic)
      column << axis, Eigen::Vector3d::Zero();
    else
      column.head<3>() = axis.cross(tool - column.head<3>());
  }
}

void Kinematics::wrench_gradient(const Vector6d& wrench,
                                 Eigen::Ref<Eigen::MatrixXd> gradient) const noexcept {
  if (chain_.size() < static_cast<std::size_t>(dof())) gradient.setZero();
  const Eigen::Vector3d force = wrench.head<3>();
  const Eigen::Vector3d moment = wrench.tail<3>();
  for (std::size_t b = 0; b < chain_.size(); ++b) {
    const Eigen::Index j = chain_[b].joint;
    Eigen::Array<double, 2, 3> both;  // of the column's linear part alone, and of all of it
    both.row(0) = jacobian_.col(j).head<3>().cross(force);
    both.row(1) = both.row(0).matrix() + jacobian_.col(j).tail<3>().cross(moment).transpose();
    for (std::size_t a = 0; a <= b; ++a) {
      const Eigen::Index i = chain_[a].joint;
      const auto axis = jacobian_.col(i).tail<3>();
      const Eigen::Array2d turned =
          both.col(0) * axis(0) + both.col(1) * axis(1) + both.col(2) * axis(2);
      gradient(i, j) = turned(0);
      gradient(j, i) = turned(1);
    }
  }
}

// Each column s is a twist about the point where the frame's origin is now. With V the twist of the joints before it, which
// carry it along, ṡ = V × s and s̈ = V̇ × s + V × ṡ. Of a wrench F it is, with (X × s)·F = X·(s ×* F) and P the sum of
// q̇ᵢ·sᵢ ×* F over the joints before,
//     s̈·F = V̇·(s ×* F) − ṡ·P
Vector6d Kinematics::move_on(const Eigen::Ref<const Eigen::VectorXd>& qd,
                             const MovingWrench& wrench,
                             Eigen::Ref<Eigen::VectorXd> curvature) const noexcept {
  using Eigen::Vector3d;
  const Vector3d force = wrench.value.head<3>();
  const Vector3d moment = wrench.value.tail<3>();
  const Vector3d velocity = jacobian_.topRows<3>().lazyProduct(qd);
  Vector3d turning = Vector3d::Zero(), turning_rate = turning;  // V, V̇
  Vector3d gliding = Vector3d::Zero(), gliding_rate = gliding;
  Vector3d twice_force_rate = 2.0 * wrench.rate.head<3>();  // less P
  Vector3d twice_moment_rate = 2.0 * (wrench.rate.tail<3>() + velocity.cross(force));
  if (chain_.size() < static_cast<std::size_t>(dof())) curvature.setZero();
  for (const Link& link : chain_) {
    const double rate = qd(link.joint);
    const Vector3d v = jacobian_.col(link.joint).head<3>();
    const Vector3d w = jacobian_.col(link.joint).tail<3>();
    const Vector3d v_rate = turning.cross(v) + gliding.cross(w);
    const Vector3d w_rate = turning.cross(w);
    const Vector3d to_force = w.cross(force);
    const Vector3d to_moment = v.cross(force) + w.cross(moment);
    curvature(link.joint) = turning_rate.dot(to_moment) + gliding_rate.dot(to_force) +
                            v_rate.dot(twice_force_rate) + w_rate.dot(twice_moment_rate);
    turning += rate * w;
    gliding += rate * v;
    turning_rate += rate * w_rate;
    gliding_rate += rate * v_rate;
    twice_force_rate -= rate * to_force;
    twice_moment_rate -= rate * to_moment;
  }
  Vector6d acceleration;
  acceleration << gliding_rate + turning.cross(velocity), turning_rate;
  const Vector3d moment_curvature =
      acceleration.head<3>().cross(force) + 2.0 * velocity.cross(wrench.rate.head<3>());
  curvature.noalias() += jacobian_.bottomRows<3>().transpose().lazyProduct(moment_curvature);
  return acceleration;
}

}  // namespace seam
