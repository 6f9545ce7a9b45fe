#include <algorithm>

#include <seam/error.hpp>
#include <seam/kinematics.hpp>

namespace seam {

namespace {

// A vector that turns, or a point that moves: its value and its first two derivatives with respect to time.
struct Moving {
  Eigen::Vector3d value, rate, curvature;
};

Moving operator+(const Moving& a, const Moving& b) {
  return {a.value + b.value, a.rate + b.rate, a.curvature + b.curvature};
}
Moving operator-(const Moving& a, const Moving& b) {
  return {a.value - b.value, a.rate - b.rate, a.curvature - b.curvature};
}
Moving cross(const Moving& a, const Moving& b) {
  return {a.value.cross(b.value), a.rate.cross(b.value) + a.value.cross(b.rate),
          a.curvature.cross(b.value) + 2.0 * a.rate.cross(b.rate) + a.value.cross(b.curvature)};
}

// A vector fixed in a body that turns with an angular velocity and acceleration.
Moving turning(const Eigen::Vector3d& vector, const Eigen::Vector3d& velocity,
               const Eigen::Vector3d& acceleration) {
  const Eigen::Vector3d rate = velocity.cross(vector);
  return {vector, rate, acceleration.cross(vector) + velocity.cross(rate)};
}

}  // namespace

Kinematics::Kinematics(const RobotModel& model, const std::string& link,
                       const Eigen::Isometry3d& X_link_tool)
    : X_body_tool_(model.frame(link).X_body_frame * X_link_tool) {
  for (int i = model.frame(link).body; i >= 0;
       i = model.joints[static_cast<std::size_t>(i)].parent) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    if (joint.follows())
      throw Error("link \"" + link + "\"", "is moved by joint \"" + joint.name +
                                               "\", which follows another; take a link before it");
    chain_.push_back({i, joint.type == Joint::Type::prismatic, joint.X_parent_body, joint.axis,
                      Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  }
  if (chain_.empty()) throw Error("link \"" + link + "\"", "is moved by no joint");
  std::reverse(chain_.begin(), chain_.end());
  jacobian_.setZero(6, model.dof());
  rate_ = curvature_ = jacobian_;
  move_to(Eigen::VectorXd::Zero(model.dof()));
}

void Kinematics::move_to(const Eigen::Ref<const Eigen::VectorXd>& q) noexcept {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (Link& link : chain_) {
    X = X * link.X_parent_body;
    link.world_axis = X.linear() * link.axis;
    link.world_origin = X.translation();
    if (link.prismatic)
      X.translation() += q(link.joint) * link.world_axis;
    else
      X.linear() = X.linear() * Eigen::AngleAxisd(q(link.joint), link.axis).toRotationMatrix();
  }
  X_base_tool_ = X * X_body_tool_;
  const Eigen::Vector3d tool = X_base_tool_.translation();
  for (const Link& link : chain_) {
    if (link.prismatic)
      jacobian_.col(link.joint) << link.world_axis, Eigen::Vector3d::Zero();
    else
      jacobian_.col(link.joint) << link.world_axis.cross(tool - link.world_origin), link.world_axis;
  }
}

void Kinematics::wrench_gradient(const Vector6d& wrench,
                                 Eigen::Ref<Eigen::MatrixXd> gradient) const noexcept {
  gradient.setZero();
  const Eigen::Vector3d force = wrench.head<3>();
  const Eigen::Vector3d moment = wrench.tail<3>();
  for (std::size_t b = 0; b < chain_.size(); ++b)
    for (std::size_t a = 0; a <= b; ++a) {
      const Eigen::Index i = chain_[a].joint;
      const Eigen::Index j = chain_[b].joint;
      const Eigen::Vector3d turns = jacobian_.col(i).tail<3>();
      const double linear = force.dot(turns.cross(jacobian_.col(j).head<3>()));
      gradient(j, i) = linear + moment.dot(turns.cross(jacobian_.col(j).tail<3>()));
      if (i != j) gradient(i, j) = linear;
    }
}

void Kinematics::move_along(const Eigen::Ref<const Eigen::VectorXd>& q,
                            const Eigen::Ref<const Eigen::VectorXd>& qd) noexcept {
  move_to(q);
  // Axes and origins on the way out; the body's turning is that of the joints before it.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  Moving origin{velocity, velocity, velocity};
  const auto advance = [&](const Link& link, auto&& visit) {
    const Moving axis = turning(link.world_axis, velocity, acceleration);
    origin = origin + turning(link.world_origin - origin.value, velocity, acceleration);
    visit(axis);
    if (link.prismatic) {
      const double s = q(link.joint);
      const double sd = qd(link.joint);
      origin = origin + Moving{s * axis.value, s * axis.rate + sd * axis.value,
                               s * axis.curvature + 2.0 * sd * axis.rate};
    } else {
      acceleration += qd(link.joint) * axis.rate;
      velocity += qd(link.joint) * axis.value;
    }
  };
  for (const Link& link : chain_) {
    advance(link, [&](const Moving& axis) {
      // For now with the origin alone; the tool's motion is known at the end of the chain.
      rate_.col(link.joint) << origin.rate, axis.rate;
      curvature_.col(link.joint) << origin.curvature, axis.curvature;
    });
  }
  const Moving tool =
      origin + turning(X_base_tool_.translation() - origin.value, velocity, acceleration);
  for (const Link& link : chain_) {
    auto rate = rate_.col(link.joint);
    auto curvature = curvature_.col(link.joint);
    const Moving axis{link.world_axis, rate.tail<3>(), curvature.tail<3>()};
    const Moving at{link.world_origin, rate.head<3>(), curvature.head<3>()};
    const Moving linear = link.prismatic ? axis : cross(axis, tool - at);
    rate.head<3>() = linear.rate;
    curvature.head<3>() = linear.curvature;
    if (!link.prismatic) continue;
    rate.tail<3>().setZero();
    curvature.tail<3>().setZero();
  }
}

}  // namespace seam
