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
constexpr double short_enough = 1e-11;  // [rad or m] a step after which what is left is rounding
constexpr double worth_it = 0.01;       // of the last solution's squared error, that of a start
constexpr double converged = 1e-13;     // [m, rad] and of the step, where damped
constexpr double longest_step = 0.5;    // [rad or m]
constexpr double good_enough = 1e-12;   // [m, rad]
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

// [m² and rad²] that poses are apart, as long as they are not far.
double apart(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) noexcept {
  return (a.translation() - b.translation()).squaredNorm() +
         0.5 * (a.linear() - b.linear()).squaredNorm();
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
  heaviest_ = weight_.maxCoeff();
  nearby_ = curvature_ = softness_slope_ = Eigen::VectorXd::Zero(n);
  gradient_.setZero(n, n);
  matrix_.setZero(n + 6, n + 6);
  columns_.setZero(n + 6, 2);
  factors_ = Eigen::PartialPivLU<System>(n + 6);
  q_ = rest_;
  state_.setZero(n + 6);
  history_.states.fill(state_);
  start(q_);
}

// Where the kinematics is.
Vector6d InverseKinematics::error(const Eigen::Isometry3d& target) const noexcept {
  const Eigen::Isometry3d& X = kinematics_.X_base_tool();
  Vector6d e;
  e << X.translation() - target.translation(), rotation_vector(X.linear(), target.linear());
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
  kinematics_.move_to(q_);
  return (after - 2.0 * softness_ + before) / (h * h);
}

// The matrix of both conditions' derivatives at q_, where the kinematics is, factored.
void InverseKinematics::assemble() noexcept {
  softness_ = 0.0;
  const double least = system_.choose(kinematics_.jacobian());
  if (!(least >= damped_below_)) soften();
  kinematics_.wrench_gradient(wrench_, gradient_);
  gradient_.diagonal() += weight_;
  whole_ = softness_ > 0.0 || !(least > 0.0) || !system_.factor(gradient_);
  if (whole_) assemble_whole();
}

void InverseKinematics::assemble_whole() noexcept {
  const int n = dof();
  matrix_.topLeftCorner(n, n) = gradient_;
  matrix_.topRightCorner(n, 6) = kinematics_.jacobian().transpose();
  matrix_.bottomLeftCorner(6, n) = kinematics_.jacobian();
  matrix_.bottomRightCorner<6, 6>().setZero();
  matrix_.bottomRightCorner<6, 6>().diagonal().setConstant(-softness_);
  if (softness_ > 0.0)
    matrix_.bottomLeftCorner(6, n).noalias() -= wrench_ * softness_slope_.transpose();
  factors_.compute(matrix_);
}

void InverseKinematics::solve() noexcept {
  if (!whole_) return system_.solve(sides_);
  const int size = dof() + 6;
  for (int i = 0; i < size; ++i) columns_.row(i) = sides_[i].transpose();
  columns_ = factors_.solve(columns_).eval();
  for (int i = 0; i < size; ++i) sides_[i] = columns_.row(i).transpose();
}

bool InverseKinematics::History::is_at(const Eigen::Isometry3d& target) const noexcept {
  return length > 0 && target.matrix() == pose.matrix();
}

void InverseKinematics::History::add(const Eigen::Isometry3d& target, const Vector& now) noexcept {
  if (is_at(target)) return;
  newest = (newest + 1) % most_length;
  length = std::min(length + 1, most_length);
  states[newest] = now;
  pose = target;
}

// The polynomial through them, one tick on.
void InverseKinematics::History::go_on(Vector& next) const noexcept {
  constexpr double factors[most_length][most_length] = {
      {1.0}, {2.0, -1.0}, {3.0, -3.0, 1.0}, {4.0, -6.0, 4.0, -1.0}, {5.0, -10.0, 10.0, -5.0, 1.0}};
  next.setZero();
  for (int k = 0; k < length; ++k)
    next += factors[length - 1][k] * states[(newest + most_length - k) % most_length];
}

// Where the last solutions lead, or at the last one.
void InverseKinematics::begin(const Eigen::Isometry3d& target) noexcept {
  if (history_.length > 1 && !history_.is_at(target)) {
    history_.go_on(state_);
    go_to_state();
    if (apart(kinematics_.X_base_tool(), target) <= worth_it * apart(history_.pose, target)) return;
    history_.length = 0;
  }
  state_ = history_.states[history_.newest];
  go_to_state();
}

void InverseKinematics::go_to_state() noexcept {
  q_ = state_.head(dof());
  wrench_ = state_.tail<6>();
  kinematics_.move_to(q_);
}

// Newton's method for the conditions. With the last step comes the velocity, in the other column.
bool InverseKinematics::converge(const ToolState& target) noexcept {
  const int n = dof();
  for (int i = 0; i < most_iterations; ++i) {
    if (i > 0) kinematics_.move_to(q_);
    assemble();
    const Vector6d e = error(target.pose);
    for (int k = 0; k < n; ++k) sides_[k] << weight_(k) * (rest_(k) - q_(k)), 0.0;
    for (int k = 0; k < 6; ++k) sides_[n + k] << -e(k), target.velocity(k);
    solve();
    const double left = (e - softness_ * wrench_).norm();
    const auto [joints, wrench] = take_step();
    if (!std::isfinite(joints)) return false;
    if (softness_ == 0.0 && joints <= short_enough && wrench <= short_enough) return true;
    // Rounding keeps the last steps of a tense posture from getting shorter.
    if (joints < (i > 3 ? 10.0 * converged : converged) && left < good_enough) return true;
  }
  return false;
}

// As far as Newton's method says, or half a radian.
InverseKinematics::Step InverseKinematics::take_step() noexcept {
  const int n = dof();
  double squared = 0.0;
  for (int k = 0; k < n; ++k) squared += sides_[k](0) * sides_[k](0);
  const double length = std::sqrt(squared);
  const double scale = length > longest_step ? longest_step / length : 1.0;
  for (int k = 0; k < n; ++k) q_(k) += scale * sides_[k](0);
  Vector6d change;
  for (int k = 0; k < 6; ++k) change(k) = sides_[n + k](0) - wrench_(k);
  wrench_ += scale * change;
  return {length, change.norm() / (heaviest_ + wrench_.norm())};
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
  nearby_ = q_ - rest_;
  const Vector6d pull = J.lazyProduct(nearby_);
  wrench_ = -normal.ldlt().solve(pull);
}

void InverseKinematics::start(const Eigen::Ref<const Eigen::VectorXd>& q) noexcept {
  q_ = q;
  kinematics_.move_to(q_);
  estimate_wrench();
  history_.states[history_.newest] << q_, wrench_;
  history_.length = 0;
}

InverseKinematics::Status InverseKinematics::follow(const ToolState& target,
                                                    JointSolution& solution) noexcept {
  begin(target.pose);
  const bool near_enough = converge(target) && (softness_ * wrench_).norm() <= most_error_;
  if (!near_enough) return Status::lost;
  if (!within_limits()) return Status::beyond_limit;
  state_ << q_, wrench_;
  history_.add(target.pose, state_);
  solution.position = q_;
  solution.position_error = softness_ * wrench_.head<3>().norm();
  solution.angle_error = softness_ * wrench_.tail<3>().norm();
  move_on(target.acceleration, solution);
  return softness_ > 0.0 ? Status::damped : Status::exact;
}

// The second derivative of both conditions, by the matrix and the velocity that came with the last step.
void InverseKinematics::move_on(const Vector6d& acceleration, JointSolution& solution) noexcept {
  const int n = dof();
  solution.velocity.resize(n);
  solution.acceleration.resize(n);
  Kinematics::MovingWrench wrench{wrench_, Vector6d()};
  for (int k = 0; k < n; ++k) solution.velocity(k) = sides_[k](1);
  for (int k = 0; k < 6; ++k) wrench.rate(k) = sides_[n + k](1);
  Vector6d tool = acceleration;
  if (softness_ > 0.0) {
    tool += softness_curvature(solution.velocity) * wrench_;
    tool += 2.0 * softness_slope_.dot(solution.velocity) * wrench.rate;
  }
  tool -= kinematics_.move_on(solution.velocity, wrench, curvature_);
  for (int k = 0; k < n; ++k) sides_[k] << -curvature_(k), 0.0;
  for (int k = 0; k < 6; ++k) sides_[n + k] << tool(k), 0.0;
  solve();
  for (int k = 0; k < n; ++k) solution.acceleration(k) = sides_[k](0);
}

// Damped least squares towards the pose, within the limits; then along the poses that reach it towards the posture.
bool InverseKinematics::approach(const Eigen::Isometry3d& target) {
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
  return converge({target}) && within_limits();
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
