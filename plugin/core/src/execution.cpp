#include <cmath>
#include <limits>

#include "vectors.hpp"
#include <seam/execution.hpp>

namespace seam {

namespace {

constexpr double faded_phase = 0.05;  // x below which weights have lost their hold
constexpr double least_share =
    0.1;  // of the first kernel against the strongest, to be changed alone
constexpr double least_tau = 1e-6;   // [s]
constexpr double largest_tau = 1e9;  // [s]
constexpr double forgotten = 40.0;   // time constants after which an added forcing is nothing

const Primitive& valid(const Primitive& primitive) {
  primitive.validate();
  return primitive;
}

// f₀ = W·a₀ and f₁ = W·a₁, coordinates in blocks of four.
SEAM_WIDEST_VECTORS void learned_forcing(const double* weights, int M, int stride,
                                         const double* rows, double* first,
                                         double* second) noexcept {
  for (int d = 0; d < stride; d += lanes) {
    Lanes sum0{};
    Lanes sum1{};
    const double* w = weights + d;
    for (int j = 0; j < M; ++j, w += stride) {
      sum0 += rows[j] * SEAM_CONST_LANES(w);
      sum1 += rows[M + j] * SEAM_CONST_LANES(w);
    }
    SEAM_LANES(first + d) = sum0;
    SEAM_LANES(second + d) = sum1;
  }
}

// e ← Φe + Γ(f₀, f_m, f₁)ᵀ for every coordinate; matrices by columns.
SEAM_WIDEST_VECTORS void propagate(const double* __restrict P, const double* __restrict G,
                                   int stride, const double* __restrict f0,
                                   const double* __restrict fm, const double* __restrict f1,
                                   double* __restrict offset, double* __restrict velocity,
                                   double* __restrict lag) noexcept {
  for (int d = 0; d < stride; ++d) {
    const double y = P[0] * offset[d] + P[3] * velocity[d] + P[6] * lag[d] + G[0] * f0[d] +
                     G[3] * fm[d] + G[6] * f1[d];
    const double v = P[1] * offset[d] + P[4] * velocity[d] + P[7] * lag[d] + G[1] * f0[d] +
                     G[4] * fm[d] + G[7] * f1[d];
    offset[d] = y;
    velocity[d] = v;
    lag[d] = P[8] * lag[d];
  }
}

SEAM_WIDEST_VECTORS void observe(double k, double c, double b, int D, const double* __restrict goal,
                                 const double* __restrict offset, const double* __restrict velocity,
                                 const double* __restrict lag, const double* __restrict forcing,
                                 double* __restrict y, double* __restrict yd,
                                 double* __restrict ydd) noexcept {
  for (int d = 0; d < D; ++d) {
    y[d] = goal[d] + offset[d];
    yd[d] = velocity[d];
    ydd[d] = k * (lag[d] - offset[d]) - c * velocity[d] + b * forcing[d];
  }
}

// 1 − (10s³ − 15s⁴ + 6s⁵), and its derivative with respect to s.
double fade(double s) {
  return s < 1.0 ? 1.0 - s * s * s * (10.0 + s * (-15.0 + 6.0 * s)) : 0.0;
}
double fade_slope(double s) {
  return s < 1.0 ? -30.0 * s * s * (1.0 - s) * (1.0 - s) : 0.0;
}

}  // namespace

Execution::Execution(const Primitive& primitive)
    : gains_(valid(primitive).gains),
      tau_(primitive.tau),
      basis_(primitive),
      sample_(primitive.dimensions()) {
  const int D = primitive.dimensions();
  const int M = basis_.count();
  const int stride = padded(D);
  weights_.setZero(M, stride);
  weights_.leftCols(D) = primitive.weights;
  change_.setZero(M, stride);
  for (Eigen::VectorXd* state :
       {&extra_, &extra_rate_, &goal_, &offset_, &velocity_, &lag_, &f_start_, &f_middle_, &f_end_})
    state->setZero(stride);
  goal_.head(D) = primitive.goal;
  rows_.setZero(2 * M);
  slope_.setZero(M);
  Sample start(D);
  start.position = primitive.start_position;
  start.velocity = primitive.start_velocity;
  reinitialise(start, basis_.start_phase(), Join::dmp2);
}

void Execution::reinitialise(const Sample& at, double phase, const JoinSettings& join) noexcept {
  join_ = join;
  changed_ = extended_ = false;
  change_.setZero();
  extra_.setZero();
  extra_rate_.setZero();
  since_join_ = since_extra_ = 0.0;
  fade_time_ = M_PI * tau_;
  extra_tau_ = tau_;
  continue_at(at, phase, true);
}

// Continues from a state: what is missing of the forcing is made up for as the method says. At a join by the weights if
// they hold, on the way of a rhythmic primitive by a forcing that is added and dies out.
void Execution::continue_at(const Sample& at, double phase, bool at_join) noexcept {
  entry_phase_ = phase_ = phase;
  elapsed_ = 0.0;
  evaluate_regressor();
  rebase_extra();
  const bool by_weights = weights_hold() && (at_join || kind() == Kind::discrete);
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const Forcing has = present(d);
    const Forcing needs = needed(at, d);
    const Forcing missing{needs.value - has.value, needs.rate - has.rate};
    offset_(d) = at.position(d) - goal_(d);
    velocity_(d) = at.velocity(d);
    lag_(d) = join_.method == Join::dmp3 ? missing.value / gains_.K : 0.0;
    f_start_(d) = has.value;
    if (join_.method != Join::dmp2a && join_.method != Join::dmp2j) continue;
    f_start_(d) = needs.value;
    if (by_weights)
      change_weights(d, missing);
    else
      extend(d, missing);
  }
  refresh_sample();
}

void Execution::extend(Eigen::Index d, Forcing missing) noexcept {
  extended_ = true;
  extra_(d) += missing.value;
  if (join_.method == Join::dmp2j) extra_rate_(d) += missing.rate;
}

void Execution::change_weights(Eigen::Index d, Forcing missing) noexcept {
  changed_ = true;
  const auto row = rows_.head(basis_.count());
  auto change = change_.col(d);
  const double aa = row.squaredNorm();
  if (join_.method == Join::dmp2j) {
    const double ab = row.dot(slope_);
    const double bb = slope_.squaredNorm();
    const double determinant = aa * bb - ab * ab;
    change += row * ((bb * missing.value - ab * missing.rate) / determinant) +
              slope_ * ((aa * missing.rate - ab * missing.value) / determinant);
  } else if (join_.change == WeightChange::smallest) {
    change += row * (missing.value / aa);
  } else {
    Eigen::Index kernel = 0;
    if (join_.change == WeightChange::strongest) row.cwiseAbs().maxCoeff(&kernel);
    change(kernel) += missing.value / row(kernel);
  }
}

bool Execution::weights_hold() const noexcept {
  if (kind() == Kind::discrete && phase_ < faded_phase) return false;
  const auto row = rows_.head(basis_.count());
  const double aa = row.squaredNorm();
  if (!(aa > 1e-12)) return false;
  if (join_.method == Join::dmp2j) {
    const double own_rate =
        basis_.phase_rate(phase_, tau_) / (kind() == Kind::discrete ? phase_ : 1.0);
    const double ab = row.dot(slope_);
    return aa * slope_.squaredNorm() - ab * ab >= aa * aa * own_rate * own_rate;
  }
  if (join_.change == WeightChange::first)
    return std::abs(row(0)) > least_share * row.cwiseAbs().maxCoeff();
  return true;
}

// a(p) and ȧ at the present phase, with the amplitude.
void Execution::evaluate_regressor() noexcept {
  basis_.regressor(phase_, rows_.data());
  basis_.slope(phase_, rows_.data(), slope_.data());
  rows_.head(basis_.count()) *= amplitude_;
  slope_ *= amplitude_ * basis_.phase_rate(phase_, tau_);
}

// The forcing and its rate as they are: learned, changed and added.
Execution::Forcing Execution::present(Eigen::Index d) const noexcept {
  const auto row = rows_.head(basis_.count());
  Forcing f{weights_.col(d).dot(row), weights_.col(d).dot(slope_)};
  if (changed_) {
    const double share = kind() == Kind::rhythmic ? fade(since_join_ / fade_time_) : 1.0;
    const double slope =
        kind() == Kind::rhythmic ? fade_slope(since_join_ / fade_time_) / fade_time_ : 0.0;
    f.value += share * change_.col(d).dot(row);
    f.rate += share * change_.col(d).dot(slope_) + slope * change_.col(d).dot(row);
  }
  if (extended_) {
    const double u = since_extra_ / extra_time();
    f.value += std::exp(-u) * ((1.0 + u) * extra_(d) + since_extra_ * extra_rate_(d));
    f.rate += std::exp(-u) * ((1.0 - u) * extra_rate_(d) - u / extra_time() * extra_(d));
  }
  return f;
}

// Moves the origin of the added forcing's time to now.
void Execution::rebase_extra() noexcept {
  if (!extended_) {
    extra_.setZero();
    extra_rate_.setZero();
  }
  const double u = since_extra_ / extra_time();
  const double decay = std::exp(-u);
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const double value = decay * ((1.0 + u) * extra_(d) + since_extra_ * extra_rate_(d));
    extra_rate_(d) = decay * ((1.0 - u) * extra_rate_(d) - u / extra_time() * extra_(d));
    extra_(d) = value;
  }
  since_extra_ = 0.0;
}

Execution::Forcing Execution::needed(const Sample& at, Eigen::Index d) const noexcept {
  const double tau2 = tau_ * tau_;
  const double damping = tau_ * gains_.D;
  return {
      tau2 * at.acceleration(d) + damping * at.velocity(d) - gains_.K * (goal_(d) - at.position(d)),
      tau2 * at.jerk(d) + damping * at.acceleration(d) + gains_.K * at.velocity(d)};
}

double Execution::extra_time() const noexcept {
  return extra_tau_ / gains_.H;
}

void Execution::step(double dt) noexcept {
  if (dt != dt_) set_step(dt);
  const int M = basis_.count();
  const int stride = static_cast<int>(goal_.size());
  const double middle = elapsed_ + 0.5 * dt;
  elapsed_ += dt;
  phase_ = basis_.advance(entry_phase_, elapsed_, tau_);
  basis_.regressors(basis_.advance(entry_phase_, middle, tau_), phase_, rows_.data());
  if (amplitude_ != 1.0) rows_ *= amplitude_;
  learned_forcing(weights_.data(), M, stride, rows_.data(), f_middle_.data(), f_end_.data());
  if (changed_ || extended_) {
    add_corrections(0.5 * dt, rows_.data(), f_middle_);
    add_corrections(dt, rows_.data() + M, f_end_);
    since_join_ += dt;
    since_extra_ += dt;
    changed_ = changed_ && (kind() == Kind::discrete || since_join_ < fade_time_);
    extended_ = extended_ && since_extra_ < forgotten * extra_time();
  }
  propagate(propagator_.Phi.data(), propagator_.Gamma.data(), stride, f_start_.data(),
            f_middle_.data(), f_end_.data(), offset_.data(), velocity_.data(), lag_.data());
  f_start_.swap(f_end_);
  refresh_sample();
}

// What is changed and added, a time after now.
void Execution::add_corrections(double ahead, const double* row,
                                Eigen::VectorXd& f) const noexcept {
  if (extended_) {
    const double t = since_extra_ + ahead;
    const double u = t / extra_time();
    f += (std::exp(-u) * (1.0 + u)) * extra_ + (std::exp(-u) * t) * extra_rate_;
  }
  if (!changed_) return;
  const double share = kind() == Kind::rhythmic ? fade((since_join_ + ahead) / fade_time_) : 1.0;
  for (int j = 0; j < basis_.count(); ++j) f += (share * row[j]) * change_.row(j).transpose();
}

void Execution::set_step(double dt) noexcept {
  dt_ = dt;
  propagator_ = Propagator(gains_, tau_, dt);
}

void Execution::refresh_sample() noexcept {
  observe(gains_.K / (tau_ * tau_), gains_.D / tau_, 1.0 / (tau_ * tau_), dimensions(),
          goal_.data(), offset_.data(), velocity_.data(), lag_.data(), f_start_.data(),
          sample_.position.data(), sample_.velocity.data(), sample_.acceleration.data());
}

const Sample& Execution::state() noexcept {
  evaluate_regressor();
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const double lag_rate = -gains_.H / tau_ * lag_(d);
    sample_.jerk(d) = (gains_.K * (lag_rate - velocity_(d)) -
                       tau_ * gains_.D * sample_.acceleration(d) + present(d).rate) /
                      (tau_ * tau_);
  }
  return sample_;
}

bool Execution::set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept {
  if (goal.size() != dimensions() || !goal.allFinite()) return false;
  if (goal == goal_.head(dimensions())) return true;
  const Sample& now = state();
  goal_.head(dimensions()) = goal;
  continue_at(now, phase_, false);
  return true;
}

bool Execution::set_tau(double tau) noexcept {
  if (!(tau >= least_tau && tau <= largest_tau)) return false;
  if (tau == tau_) return true;
  const Sample& now = state();
  tau_ = tau;
  dt_ = std::numeric_limits<double>::quiet_NaN();
  continue_at(now, phase_, false);
  return true;
}

bool Execution::set_amplitude(double amplitude) noexcept {
  if (!std::isfinite(amplitude) || kind() != Kind::rhythmic) return false;
  if (amplitude == amplitude_) return true;
  const Sample& now = state();
  amplitude_ = amplitude;
  continue_at(now, phase_, false);
  return true;
}

double Execution::correction(const Sample& at, double phase) noexcept {
  basis_.regressor(phase, rows_.data());
  rows_.head(basis_.count()) *= amplitude_;
  double sum = 0.0;
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const double missing = needed(at, d).value - weights_.col(d).dot(rows_.head(basis_.count()));
    sum += missing * missing;
  }
  return sum / (tau_ * tau_ * tau_ * tau_);
}

// A scan over the cycle, then a golden-section search in each valley that it shows.
double Execution::least_correction_phase(const Sample& at) noexcept {
  if (kind() == Kind::discrete) return basis_.start_phase();
  constexpr int scan = 180;
  constexpr double width = 2.0 * M_PI / scan;
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double before = correction(at, -width);
  double here = correction(at, 0.0);
  for (int i = 0; i < scan; ++i) {
    const double after = correction(at, (i + 1) * width);
    if (here <= before && here <= after) {
      const double phase = valley(at, (i - 1) * width, (i + 1) * width);
      const double depth = correction(at, phase);
      if (depth < least) least = depth, best = phase;
    }
    before = here;
    here = after;
  }
  return best < 0.0 ? best + 2.0 * M_PI : best;
}

double Execution::valley(const Sample& at, double low, double high) noexcept {
  constexpr double golden = 0.6180339887498949;
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double at_left = correction(at, left);
  double at_right = correction(at, right);
  while (high - low > 1e-8) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - golden * (high - low);
      at_left = correction(at, left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + golden * (high - low);
      at_right = correction(at, right);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace seam
