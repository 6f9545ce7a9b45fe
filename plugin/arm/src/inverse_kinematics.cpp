#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Cholesky>

#include <seam/error.hpp>
#include <seam/inverse_kinematics.hpp>
#include <seam/orientation.hpp>

namespace seam {

namespace {

constexpr int most_iterations = 20;
constexpr double converged = 1e-13;    // [m, rad] and of the step
constexpr double longest_step = 0.5;   // [rad or m]
constexpr double good_enough = 1e-12;  // [m, rad]
constexpr int starts = 60;
constexpr double near = 1e-6;  // [rad or m] for differences

Eigen::VectorXd filled(const Eigen::VectorXd& given, const Eigen::VectorXd& standard,
                       const std::string& name) {
  if (given.size() == 0) return standard;
  if (given.size() != standard.size() || !given.allFinite())
    throw Error("posture", name + " must be " + std::to_string(standard.size()) +
                               " finite numbers, one per joint");
  return given;
}

double middle(const Joint& joint) {
  return std::isfinite(joint.lower) && std::isfinite(joint.upper)
             ? 0.5 * (joint.lower + joint.upper)
             : 0.0;
}

}  // namespace

InverseKinematics::InverseKinematics(const RobotModel& model, Kinematics kinematics,
                                     const PostureSettings& posture)
    : kinematics_(std::move(kinematics)),
      lower_(model.dof()),
      upper_(model.dof()),
      damped_below_(posture.damped_below),
      damping_(posture.damping),
      most_error_(posture.most_error) {
  const int n = model.dof();
  if (n > most) throw Error("robot", "more than " + std::to_string(most) + " joints");
  Eigen::VectorXd middles(n);
  for (int i = 0; i < n; ++i) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    lower_(i) = joint.lower;
    upper_(i) = joint.upper;
    middles(i) = middle(joint);
  }
  if ((kinematics_.jacobian().array() != 0.0).colwise().any().count() < 6)
    throw Error("robot", "fewer than six joints move the tool");
  rest_ = filled(posture.rest, middles, "rest");
  weight_ = filled(posture.weight, Eigen::VectorXd::Ones(n), "weight");
  if (weight_.minCoeff() <= 0.0) throw Error("posture", "weight must be > 0");
  for (const double value : {damped_below_, damping_, most_error_})
    if (!(std::isfinite(value) && value >= 0.0))
      throw Error("posture", "damping " + std::to_string(value) + ", must be >= 0");
  softness_slope_.setZero(n);
  nearby_.setZero(n);
  gradient_.setZero(n, n);
  system_.setZero(n + 6, n + 6);
  right_.setZero(n + 6);
  step_ = right_;
  factors_ = Eigen::PartialPivLU<System>(n + 6);
  q_ = rest_;
}

Vector6d InverseKinematics::error(const Eigen::Isometry3d& target) const noexcept {
  const Eigen::Isometry3d& X = kinematics_.X_base_tool();
  Vector6d e;
  e << X.translation() - target.translation(),
      rotation_vector(Eigen::Quaterniond(X.linear()), Eigen::Quaterniond(target.linear()));
  return e;
}

// λ² where the kinematics is.
double InverseKinematics::softness_here() const noexcept {
  if (damped_below_ == 0.0) return 0.0;
  const Jacobian& J = kinematics_.jacobian();
  const Eigen::Matrix<double, 6, 6> square = J * J.transpose();
  const double w = std::sqrt(std::max(square.determinant(), 0.0));
  const double short_of = 1.0 - w / damped_below_;
  return short_of > 0.0 ? damping_ * short_of * short_of * short_of * short_of : 0.0;
}

// At other joint positions; leaves the kinematics there.
double InverseKinematics::softness_at(const Eigen::VectorXd& q) noexcept {
  kinematics_.move_to(q);
  return softness_here();
}

// λ² and its slope at q_, where the kinematics is, by central differences.
void InverseKinematics::soften() noexcept {
  softness_slope_.setZero();
  softness_ = softness_here();
  if (softness_ == 0.0) return;
  nearby_ = q_;
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    nearby_(i) = q_(i) + near;
    const double above = softness_at(nearby_);
    nearby_(i) = q_(i) - near;
    softness_slope_(i) = (above - softness_at(nearby_)) / (2.0 * near);
    nearby_(i) = q_(i);
  }
  kinematics_.move_to(q_);
}

// d²λ²/dt² while the joints move on at constant velocities.
double InverseKinematics::softness_curvature(const Eigen::VectorXd& qd) noexcept {
  const double speed = qd.norm();
  if (softness_ == 0.0 || speed == 0.0) return 0.0;
  const double h = 1e2 * near / speed;
  nearby_ = q_ + h * qd;
  const double after = softness_at(nearby_);
  nearby_ = q_ - h * qd;
  const double before = softness_at(nearby_);
  return (after - 2.0 * softness_ + before) / (h * h);
}

// The matrix of both conditions' derivatives at q_, where the kinematics is, factored.
void InverseKinematics::assemble() noexcept {
  const int n = dof();
  soften();
  kinematics_.wrench_gradient(wrench_, gradient_);
  system_.topLeftCorner(n, n) = gradient_;
  system_.topLeftCorner(n, n).diagonal() += weight_;
  system_.topRightCorner(n, 6) = kinematics_.jacobian().transpose();
  system_.bottomLeftCorner(6, n) = kinematics_.jacobian();
  system_.bottomLeftCorner(6, n).noalias() -= wrench_ * softness_slope_.transpose();
  system_.bottomRightCorner<6, 6>().setZero();
  system_.bottomRightCorner<6, 6>().diagonal().setConstant(-softness_);
  factors_.compute(system_);
}

bool InverseKinematics::converge(const Eigen::Isometry3d& target) noexcept {
  const int n = dof();
  for (int i = 0; i < most_iterations; ++i) {
    kinematics_.move_to(q_);
    assemble();
    const Vector6d e = error(target) - softness_ * wrench_;
    right_.head(n) = -weight_.cwiseProduct(q_ - rest_);
    right_.head(n).noalias() -= kinematics_.jacobian().transpose() * wrench_;
    right_.tail<6>() = -e;
    step_.noalias() = factors_.solve(right_);
    const double length = step_.head(n).norm();
    if (!std::isfinite(length)) return false;
    const double scale = length > longest_step ? longest_step / length : 1.0;
    q_ += scale * step_.head(n);
    wrench_ += scale * step_.tail<6>();
    if (length < converged && e.norm() < good_enough) return true;
    // Rounding keeps the last steps of a tense posture from getting shorter.
    if (i > 3 && length < 10.0 * converged && e.norm() < good_enough) return true;
  }
  return false;
}

bool InverseKinematics::within_limits() const noexcept {
  return (q_.array() >= lower_.array()).all() && (q_.array() <= upper_.array()).all();
}

// The multipliers that fit the first condition best.
void InverseKinematics::estimate_wrench() noexcept {
  const Jacobian& J = kinematics_.jacobian();
  scaled_ = J * weight_.cwiseInverse().asDiagonal();
  Eigen::Matrix<double, 6, 6> normal = scaled_.lazyProduct(J.transpose());
  normal.diagonal().array() += 1e-12;
  step_.head(dof()) = q_ - rest_;
  const Vector6d pull = J.lazyProduct(step_.head(dof()));
  wrench_ = -normal.ldlt().solve(pull);
}

void InverseKinematics::start(const Eigen::Ref<const Eigen::VectorXd>& q) noexcept {
  q_ = q;
  kinematics_.move_to(q_);
  estimate_wrench();
}

InverseKinematics::Status InverseKinematics::follow(const ToolState& target,
                                                    JointSolution& solution) noexcept {
  const int n = dof();
  solution.position = q_;
  const Vector6d wrench_before = wrench_;
  const bool found = converge(target.pose);
  kinematics_.move_to(q_);
  const Vector6d e = error(target.pose);
  const bool near_enough = found && e.norm() <= most_error_;
  if (!near_enough || !within_limits()) {
    q_ = solution.position;
    wrench_ = wrench_before;
    return near_enough ? Status::beyond_limit : Status::lost;
  }
  solution.position = q_;
  solution.position_error = e.head<3>().norm();
  solution.angle_error = e.tail<3>().norm();
  assemble();
  right_.head(n).setZero();
  right_.tail<6>() = target.velocity;
  step_.noalias() = factors_.solve(right_);
  solution.velocity = step_.head(n);
  const Vector6d wrench_rate = step_.tail<6>();
  const double softness_rate = softness_slope_.dot(solution.velocity);
  const double softness_curvature = this->softness_curvature(solution.velocity);
  kinematics_.move_along(q_, solution.velocity);
  right_.head(n).noalias() = -2.0 * kinematics_.jacobian_rate().transpose() * wrench_rate;
  right_.head(n).noalias() -= kinematics_.jacobian_curvature().transpose() * wrench_;
  right_.tail<6>() = target.acceleration;
  right_.tail<6>().noalias() -= kinematics_.jacobian_rate() * solution.velocity;
  right_.tail<6>() += softness_curvature * wrench_ + 2.0 * softness_rate * wrench_rate;
  step_.noalias() = factors_.solve(right_);
  solution.acceleration = step_.head(n);
  return softness_ > 0.0 ? Status::damped : Status::exact;
}

// Damped least squares towards the pose, within the limits; then along the poses that reach it towards the posture.
bool InverseKinematics::approach(const Eigen::Isometry3d& target) {
  const int n = dof();
  double damping = 1e-2;
  kinematics_.move_to(q_);
  double squared = error(target).squaredNorm();
  for (int i = 0; i < 300 && squared > 1e-24; ++i) {
    const Eigen::MatrixXd J = kinematics_.jacobian();
    const Eigen::MatrixXd normal =
        J * J.transpose() + damping * Eigen::Matrix<double, 6, 6>::Identity();
    const Eigen::VectorXd before = q_;
    q_ -= J.transpose() * normal.ldlt().solve(error(target));
    q_ = q_.cwiseMax(lower_).cwiseMin(upper_);
    kinematics_.move_to(q_);
    const double next = error(target).squaredNorm();
    if (next < squared) {
      squared = next;
      damping = std::max(0.2 * damping, 1e-12);
    } else {
      q_ = before;
      kinematics_.move_to(q_);
      damping *= 5.0;
      if (damping > 1e6) break;
    }
  }
  if (squared > 1e-16) return false;
  for (int i = 0; i < 200; ++i) {
    estimate_wrench();
    const Eigen::VectorXd slope =
        (q_ - rest_) +
        kinematics_.jacobian().transpose().cwiseQuotient(weight_.replicate(1, 6)) * wrench_;
    if (slope.norm() < 1e-3) break;
    q_ -= std::min(0.3, 0.1 / slope.norm()) * slope;
    for (int k = 0; k < 3; ++k) {
      kinematics_.move_to(q_);
      const Eigen::MatrixXd J = kinematics_.jacobian();
      q_ -= J.transpose() * (J * J.transpose() + 1e-9 * Eigen::Matrix<double, 6, 6>::Identity())
                                .ldlt()
                                .solve(error(target));
    }
    kinematics_.move_to(q_);
  }
  estimate_wrench();
  return q_.size() == n && converge(target) && within_limits();
}

double InverseKinematics::posture_cost() const noexcept {
  return (q_ - rest_).cwiseAbs2().dot(weight_);
}

Eigen::VectorXd InverseKinematics::reach(const Eigen::Isometry3d& pose) {
  std::mt19937_64 random(1);
  const auto anywhere = [&](Eigen::Index i) {
    const double low = std::max(lower_(i), -M_PI);
    const double high = std::min(upper_(i), M_PI);
    return low + (high - low) * (static_cast<double>(random()) / 18446744073709551616.0);
  };
  Eigen::VectorXd best;
  double cost = std::numeric_limits<double>::infinity();
  Vector6d nearest = Vector6d::Constant(std::numeric_limits<double>::infinity());
  for (int attempt = 0; attempt < starts; ++attempt) {
    for (Eigen::Index i = 0; i < q_.size(); ++i) q_(i) = attempt == 0 ? rest_(i) : anywhere(i);
    if (approach(pose)) {
      if (posture_cost() < cost - 1e-9) cost = posture_cost(), best = q_;
    } else {
      kinematics_.move_to(q_);
      const Vector6d miss = error(pose);
      if (miss.norm() < nearest.norm()) nearest = miss;
    }
  }
  if (best.size() == 0)
    throw Error("pose", "out of reach by " + std::to_string(nearest.head<3>().norm()) + " m and " +
                            std::to_string(nearest.tail<3>().norm()) + " rad");
  start(best);
  return best;
}

}  // namespace seam
