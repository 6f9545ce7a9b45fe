#include "require_inertia.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Eigenvalues>

#include "text.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr int positions = 300;
constexpr double least_share = 1e-5;
constexpr double rounding = 1e-12;  // of what a joint moves

// The joint's column of a body's Jacobian: velocity of its centre of mass, and of its turning.
struct Column {
  Eigen::Vector3d linear, angular;
};

Column column(const Joint& joint, const Eigen::Isometry3d& X_base_joint,
              const Eigen::Vector3d& com) {
  const Eigen::Vector3d axis = X_base_joint.linear() * joint.axis;
  if (joint.type == Joint::Type::prismatic) return {axis, Eigen::Vector3d::Zero()};
  return {axis.cross(com - X_base_joint.translation()), axis};
}

// One of the positions at which joints like to line up, or any.
double anywhere(const Joint& joint, std::mt19937_64& random) {
  const double low = std::max(joint.lower, -M_PI);
  const double high = std::min(joint.upper, M_PI);
  const auto part = static_cast<double>(random() >> 11) * 0x1p-53;
  const double any = low + part * (high - low);
  const double choices[] = {any, any, 0.0, 0.5 * (low + high), low, high, 0.5 * M_PI, -0.5 * M_PI};
  return std::min(std::max(choices[random() % 8], low), high);
}

// Has no mass, is a point or a line, or has a moment that no body has. (One whose moments are all positive adds to M(q)
// everywhere, whether they keep the triangle rule or not.)
bool lacks_inertia(const Body& body) {
  const Eigen::Matrix3d& inertia = body.inertial.inertia;
  return inertia.selfadjointView<Eigen::Lower>().eigenvalues()(0) <= 1e-12 * inertia.trace();
}

// M(q), and what its diagonal would be, at the most, if the joints' axes were turned.
struct JointInertia {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd about_any_axis;
};

JointInertia joint_inertia(const RobotModel& model, const Eigen::VectorXd& q) {
  const int n = model.dof();
  std::vector<Eigen::Isometry3d> X_base_body, X_base_joint;
  JointInertia all{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  for (int i = 0; i < n; ++i) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    const Eigen::Isometry3d X_base_parent =
        joint.parent < 0 ? Eigen::Isometry3d::Identity()
                         : X_base_body[static_cast<std::size_t>(joint.parent)];
    X_base_joint.push_back(X_base_parent * joint.X_parent_body);
    X_base_body.push_back(X_base_parent * joint.X_parent_body_at(q(i)));
    const Inertial body = X_base_body.back() * model.bodies[static_cast<std::size_t>(i)].inertial;
    Eigen::Matrix3Xd linear = Eigen::Matrix3Xd::Zero(3, n), angular = linear;
    for (int k = i; k >= 0; k = model.joints[static_cast<std::size_t>(k)].parent) {
      const Joint& moves = model.joints[static_cast<std::size_t>(k)];
      const Eigen::Isometry3d& X_base_k = X_base_joint[static_cast<std::size_t>(k)];
      const Column moved = column(moves, X_base_k, body.com);
      linear.col(k) = moved.linear;
      angular.col(k) = moved.angular;
      const double arm2 = (body.com - X_base_k.translation()).squaredNorm();
      all.about_any_axis(k) += moves.type == Joint::Type::prismatic
                                   ? body.mass
                                   : body.mass * arm2 + body.inertia.trace();
    }
    all.matrix +=
        body.mass * linear.transpose() * linear + angular.transpose() * body.inertia * angular;
  }
  return all;
}

// The joints' motion that meets least inertia, for a diagonal of ones.
struct Weakest {
  double share;
  Eigen::VectorXd motion;
};

Weakest weakest(const JointInertia& inertia) {
  const Eigen::MatrixXd& M = inertia.matrix;
  const Eigen::VectorXd least = rounding * inertia.about_any_axis;
  const Eigen::VectorXd scale = M.diagonal()
                                    .cwiseMax(least)
                                    .cwiseMax(std::numeric_limits<double>::min())
                                    .cwiseSqrt()
                                    .cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * M *
                                                              scale.asDiagonal());
  return {solver.eigenvalues()(0), solver.eigenvectors().col(0).cwiseAbs()};
}

[[noreturn]] void refuse(const RobotModel& model, std::size_t body, const std::string& path) {
  const Inertial& inertial = model.bodies[body].inertial;
  const Eigen::Vector3d moments = inertial.inertia.selfadjointView<Eigen::Lower>().eigenvalues();
  const std::string has =
      moments(0) < -rounding * inertial.inertia.norm()
          ? text("has the principal moments of inertia ", moments(0), ", ", moments(1), ", ",
                 moments(2), " kg m^2, with what is fixed to it")
          : text("has no ", inertial.mass > 0.0 ? "inertia" : "mass",
                 ", nor has any link fixed to it");
  throw Error(path + ": link \"" + model.bodies[body].link + "\"",
              text(has, ", but joint \"", model.joints[body].name,
                   "\" moves it, and in some position nothing behind it resists: must be > 0"));
}

}  // namespace

Eigen::MatrixXd inertia_matrix(const RobotModel& model, const Eigen::VectorXd& q) {
  return joint_inertia(model, q).matrix;
}

void require_inertia(const RobotModel& model, const std::string& path) {
  std::vector<std::size_t> suspects;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (lacks_inertia(model.bodies[i])) suspects.push_back(i);
  if (suspects.empty()) return;
  std::mt19937_64 random(1);
  Eigen::VectorXd q(model.dof());
  for (int k = 0; k < positions; ++k) {
    for (int i = 0; i < model.dof(); ++i)
      q(i) = anywhere(model.joints[static_cast<std::size_t>(i)], random);
    const auto [share, motion] = weakest(joint_inertia(model, q));
    if (share >= least_share) continue;
    std::size_t suspect = suspects.front();
    for (const std::size_t i : suspects)
      if (motion(static_cast<Eigen::Index>(i)) > motion(static_cast<Eigen::Index>(suspect)))
        suspect = i;
    refuse(model, suspect, path);
  }
}

}  // namespace seam
