#include "require_inertia.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Eigenvalues>

#include "text.hpp"
#include "urdf_place.hpp"

namespace seam {

namespace {

constexpr int random_positions = 100;
constexpr int few_positions = 2;  // of the random ones
constexpr int special_positions = 300;
constexpr double least_share = 1e-5;
constexpr double negative = -1e-9;  // share that no rounding makes
constexpr double water = 1000.0;    // [kg/m³]
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

class Positions {
 public:
  explicit Positions(const RobotModel& model) : model_(model), q_(model.dof()) {}

  const Eigen::VectorXd& any() {
    return each([](double low, double high, double part, std::uint64_t) {
      return low + part * (high - low);
    });
  }
  /// Where joints like to line up.
  const Eigen::VectorXd& special() {
    return each([](double low, double high, double part, std::uint64_t draw) {
      const double any = low + part * (high - low);
      const double choices[] = {any, any,  0.0,        0.5 * (low + high),
                                low, high, 0.5 * M_PI, -0.5 * M_PI};
      return std::min(std::max(choices[draw % 8], low), high);
    });
  }

 private:
  template <typename Choose>
  const Eigen::VectorXd& each(Choose choose) {
    for (int i = 0; i < model_.dof(); ++i) {
      const Joint& joint = model_.joints[static_cast<std::size_t>(i)];
      const auto part = static_cast<double>(random_() >> 11) * 0x1p-53;
      q_(i) = choose(std::max(joint.lower, std::min(-M_PI, joint.upper)),
                     std::min(joint.upper, std::max(M_PI, joint.lower)), part, random_());
    }
    return q_;
  }

  const RobotModel& model_;
  std::mt19937_64 random_{1};
  Eigen::VectorXd q_;
};

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

// What was seen in many positions.
struct Look {
  int weak = 0;            // positions without inertia
  Weakest worst{1.0, {}};  // of them all
};

template <typename Next>
Look look(const RobotModel& model, int positions, Next next) {
  Look seen;
  for (int k = 0; k < positions; ++k) {
    const Weakest here = weakest(joint_inertia(model, next()));
    if (here.share >= least_share) continue;
    ++seen.weak;
    if (here.share < seen.worst.share) seen.worst = here;
  }
  return seen;
}

class Inertia {
 public:
  Inertia(RobotModel& model, const std::string& path) : model_(model), path_(path) {
    for (std::size_t i = 0; i < model.bodies.size(); ++i)
      if (lacks_inertia(model.bodies[i])) suspects_.push_back(i);
  }

  void require() {
    if (suspects_.empty()) return;
    Positions positions(model_);
    const auto any = [&] { return positions.any(); };
    Look seen = look(model_, random_positions, any);
    while (seen.weak > few_positions && seen.worst.share > negative) {
      if (!add_inertia(seen.worst.motion)) break;
      seen = look(model_, random_positions, any);
    }
    if (suspects_.empty()) return;
    if (seen.weak > random_positions / 2 || seen.worst.share < negative) refuse(seen.worst);
    seen = look(model_, special_positions, [&] { return positions.special(); });
    if (seen.worst.share < negative) refuse(seen.worst);
    if (seen.weak > 0) warn(seen.worst);
  }

 private:
  Body& body(std::size_t i) { return model_.bodies[i]; }

  std::size_t suspect_in(const Weakest& weakest) const {
    return *std::max_element(suspects_.begin(), suspects_.end(), [&](std::size_t a, std::size_t b) {
      return weakest.motion(static_cast<Eigen::Index>(a)) <
             weakest.motion(static_cast<Eigen::Index>(b));
    });
  }

  // Makes a ball of the heaviest point that the motion turns. False if it turns none.
  bool add_inertia(const Eigen::VectorXd& motion) {
    std::size_t heaviest = model_.bodies.size();
    for (const std::size_t i : suspects_) {
      if (motion(static_cast<Eigen::Index>(i)) < 0.1 * motion.maxCoeff()) continue;
      if (heaviest == model_.bodies.size() || mass(i) > mass(heaviest)) heaviest = i;
    }
    if (heaviest == model_.bodies.size() || !(mass(heaviest) > 0.0)) return false;
    const double radius = std::cbrt(mass(heaviest) / (water * 4.0 / 3.0 * M_PI));
    const double moment = 0.4 * mass(heaviest) * radius * radius;
    body(heaviest).inertial.inertia.diagonal().array() += moment;
    suspects_.erase(std::find(suspects_.begin(), suspects_.end(), heaviest));
    place(heaviest).warn(text("has no inertia that joint \"", model_.joints[heaviest].name,
                              "\" would meet: ", moment,
                              " kg m^2 added, a ball's of water of its mass"));
    return true;
  }

  std::string lack(std::size_t i) {
    const Eigen::Matrix3d& inertia = body(i).inertial.inertia;
    const Eigen::Vector3d moments = inertia.selfadjointView<Eigen::Lower>().eigenvalues();
    if (moments(0) < -rounding * inertia.norm())
      return text("has the principal moments of inertia ", moments(0), ", ", moments(1), ", ",
                  moments(2), " kg m^2, with what is fixed to it");
    return text("has no ", mass(i) > 0.0 ? "inertia" : "mass", ", nor has any link fixed to it");
  }

  [[noreturn]] void refuse(const Weakest& weakest) {
    const std::size_t i = suspect_in(weakest);
    place(i).refuse(text(lack(i), ", but joint \"", model_.joints[i].name,
                         "\" moves it, and nothing behind it resists: must be > 0"));
  }

  void warn(const Weakest& weakest) {
    const std::size_t i = suspect_in(weakest);
    place(i).warn(text(lack(i), ", and in some positions nothing behind it resists joint \"",
                       model_.joints[i].name, "\": accelerations have no bound there"));
  }

  double mass(std::size_t i) const { return model_.bodies[i].inertial.mass; }
  UrdfPlace place(std::size_t i) {
    return {path_, "link \"" + body(i).link + "\"", model_.warnings};
  }

  RobotModel& model_;
  const std::string& path_;
  std::vector<std::size_t> suspects_;
};

}  // namespace

Eigen::MatrixXd inertia_matrix(const RobotModel& model, const Eigen::VectorXd& q) {
  return joint_inertia(model, q).matrix;
}

void require_inertia(RobotModel& model, const std::string& path) {
  Inertia(model, path).require();
}

}  // namespace seam
