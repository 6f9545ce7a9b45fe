#include "require_inertia.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "text.hpp"
#include "urdf_place.hpp"

namespace seam {

namespace {

constexpr int random_positions = 100;
constexpr int few_positions = 3;  // of the random ones
constexpr int most_balls = 20;    // one by one, then all at once, as where there are
constexpr int many_joints = 100;
constexpr double least_inertia = 1e-15;  // [kg m² or kg]
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

// Of each joint: where it is in the base, and all that it moves as one body, in the base.
struct Placed {
  std::vector<Eigen::Isometry3d> X_base_joint;
  std::vector<Inertial> moved;
};

Placed placed(const RobotModel& model, const Eigen::VectorXd& q) {
  Placed all;
  std::vector<Eigen::Isometry3d> X_base_body;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const Eigen::Isometry3d X_base_parent =
        joint.parent < 0 ? Eigen::Isometry3d::Identity()
                         : X_base_body[static_cast<std::size_t>(joint.parent)];
    all.X_base_joint.push_back(X_base_parent * joint.X_parent_body);
    X_base_body.push_back(X_base_parent * joint.X_parent_body_at(q(static_cast<Eigen::Index>(i))));
    all.moved.push_back(X_base_body.back() * model.bodies[i].inertial);
  }
  for (std::size_t i = model.joints.size(); i-- > 0;) {
    const int parent = model.joints[i].parent;
    if (parent < 0) continue;
    Inertial& before = all.moved[static_cast<std::size_t>(parent)];
    before = before + all.moved[i];
  }
  return all;
}

// By composite rigid bodies, about their centres of mass.
JointInertia joint_inertia(const RobotModel& model, const Eigen::VectorXd& q) {
  const int n = model.dof();
  const Placed all = placed(model, q);
  JointInertia inertia{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  for (int i = 0; i < n; ++i) {
    const Inertial& moved = all.moved[static_cast<std::size_t>(i)];
    const auto at_com = [&](int k) {
      const auto j = static_cast<std::size_t>(k);
      return column(model.joints[j], all.X_base_joint[j], moved.com);
    };
    const Column own = at_com(i);
    const Eigen::Vector3d linear = moved.mass * own.linear, angular = moved.inertia * own.angular;
    for (int k = i; k >= 0; k = model.joints[static_cast<std::size_t>(k)].parent) {
      const Column theirs = at_com(k);
      inertia.matrix(i, k) = inertia.matrix(k, i) =
          theirs.linear.dot(linear) + theirs.angular.dot(angular);
    }
    const Eigen::Isometry3d& X_base_joint = all.X_base_joint[static_cast<std::size_t>(i)];
    const double arm2 = (moved.com - X_base_joint.translation()).squaredNorm();
    const bool linear_joint =
        model.joints[static_cast<std::size_t>(i)].type == Joint::Type::prismatic;
    inertia.about_any_axis(i) =
        linear_joint ? moved.mass : moved.mass * arm2 + moved.inertia.trace();
  }
  return inertia;
}

// The joints' motion that meets least inertia, for a diagonal of ones.
struct Weakest {
  double share = 1.0;
  Eigen::VectorXd motion;
};

// Of those whose share is too small.
std::optional<Weakest> weakest(const JointInertia& inertia) {
  const Eigen::VectorXd scale = inertia.matrix.diagonal()
                                    .cwiseMax(rounding * inertia.about_any_axis)
                                    .cwiseMax(std::numeric_limits<double>::min())
                                    .cwiseSqrt()
                                    .cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * inertia.matrix * scale.asDiagonal();
  const auto n = scaled.rows();
  const Eigen::LLT<Eigen::MatrixXd> more(scaled - least_share * Eigen::MatrixXd::Identity(n, n));
  if (more.info() == Eigen::Success) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  return Weakest{solver.eigenvalues()(0), solver.eigenvectors().col(0).cwiseAbs()};
}

// What was seen in many positions.
struct Look {
  int weak = 0;   // positions without inertia
  Weakest worst;  // of them
};

// Stops after so many that are weak.
template <typename Next>
Look look(const RobotModel& model, int positions, int enough, Next next) {
  Look seen;
  for (int k = 0; k < positions && seen.weak < enough; ++k) {
    const auto here = weakest(joint_inertia(model, next()));
    if (!here) continue;
    ++seen.weak;
    if (here->share < seen.worst.share) seen.worst = *here;
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
    look_at_suspects();
    require_size();
  }

 private:
  void look_at_suspects() {
    if (suspects_.empty()) return;
    Positions positions(model_);
    const auto any = [&] { return positions.any(); };
    const auto special = [&] { return positions.special(); };
    Look seen = look(model_, random_positions, few_positions, any);
    for (int balls = 0; seen.weak == few_positions && seen.worst.share > negative; ++balls) {
      const bool at_once = balls == most_balls || model_.dof() > many_joints;
      if (!(at_once ? add_to_all() : add_to_heaviest(seen.worst.motion))) break;
      seen = look(model_, random_positions, few_positions, any);
    }
    if (suspects_.empty()) return;
    seen = look(model_, random_positions, random_positions / 2, any);
    if (seen.weak == random_positions / 2 || seen.worst.share < negative) refuse(seen.worst);
    const Look lined_up = look(model_, special_positions, special_positions, special);
    if (lined_up.worst.share < negative) refuse(lined_up.worst);
    if (lined_up.weak + seen.weak > 0) warn(lined_up.weak > 0 ? lined_up.worst : seen.worst);
  }

  Body& body(std::size_t i) { return model_.bodies[i]; }

  std::size_t suspect_in(const Weakest& weakest) const {
    return *std::max_element(suspects_.begin(), suspects_.end(), [&](std::size_t a, std::size_t b) {
      return weakest.motion(static_cast<Eigen::Index>(a)) <
             weakest.motion(static_cast<Eigen::Index>(b));
    });
  }

  // Bullet takes less for none, and such a joint for one that never moves.
  void require_size() {
    const Eigen::VectorXd least = joint_inertia(model_, model_.neutral()).about_any_axis;
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      const double most = least(static_cast<Eigen::Index>(i));
      if (most > least_inertia) continue;
      const Joint& joint = model_.joints[i];
      const char* const unit = joint.type == Joint::Type::prismatic ? " kg" : " kg m^2";
      UrdfPlace(path_, "joint \"" + joint.name + "\"", model_.warnings)
          .refuse(text("moves an inertia of ", most, unit, ", must be > ", least_inertia));
    }
  }

  // Makes a ball of the heaviest point that the motion turns. False if it turns none.
  bool add_to_heaviest(const Eigen::VectorXd& motion) {
    auto heaviest = suspects_.end();
    for (auto i = suspects_.begin(); i != suspects_.end(); ++i) {
      if (motion(static_cast<Eigen::Index>(*i)) < 0.1 * motion.maxCoeff()) continue;
      if (heaviest == suspects_.end() || mass(*i) > mass(*heaviest)) heaviest = i;
    }
    if (heaviest == suspects_.end() || !(mass(*heaviest) > 0.0)) return false;
    make_ball(*heaviest);
    suspects_.erase(heaviest);
    return true;
  }

  bool add_to_all() {
    const auto points = std::partition(suspects_.begin(), suspects_.end(),
                                       [&](std::size_t i) { return !(mass(i) > 0.0); });
    const bool any = points != suspects_.end();
    std::for_each(points, suspects_.end(), [&](std::size_t i) { make_ball(i); });
    suspects_.erase(points, suspects_.end());
    return any;
  }

  void make_ball(std::size_t i) {
    const double radius = std::cbrt(mass(i) / (water * 4.0 / 3.0 * M_PI));
    const double moment = 0.4 * mass(i) * radius * radius;
    body(i).inertial.inertia.diagonal().array() += moment;
    place(i).warn(text("has no inertia that joint \"", model_.joints[i].name,
                       "\" would meet: ", moment, " kg m^2 added, a ball's of water of its mass"));
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

Eigen::VectorXd RobotModel::moved_inertia(const Eigen::VectorXd& q) const {
  return joint_inertia(*this, q).matrix.diagonal();
}

void require_inertia(RobotModel& model, const std::string& path) {
  Inertia(model, path).require();
}

}  // namespace seam
