#include <cmath>
#include <limits>

#include "vectors.hpp"
#include <seam/execution.hpp>

namespace seam {

namespace {

constexpr double faded_phase = 0.05;  // x below which weights have lost their hold
constexpr double least_angle2 =
    1e-3;  // sine squared between a and ȧ, for both to be met by the weights
constexpr double least_share =
    0.1;  // of the first kernel against the strongest, for it to be changed alone

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

// 1 − (10s³ − 15s⁴ + 6s⁵) and s − 6s³ + 8s⁴ − 3s⁵: from (1, 0, 0) and (0, 1, 0) at s = 0 to (0, 0, 0) at 1.
double fade_value(double s) {
  return s < 1.0 ? 1.0 - s * s * s * (10.0 + s * (-15.0 + 6.0 * s)) : 0.0;
}
double fade_rate(double s) {
  return s < 1.0 ? s * (1.0 + s * s * (-6.0 + s * (8.0 - 3.0 * s))) : 0.0;
}

// Their derivatives with respect to s.
double fade_value_slope(double s) {
  return s < 1.0 ? -30.0 * s * s * (1.0 - s) * (1.0 - s) : 0.0;
}
double fade_rate_slope(double s) {
  return s < 1.0 ? 1.0 + s * s * (-18.0 + s * (32.0 - 15.0 * s)) : 0.0;
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
  entry_phase_ = phase_ = phase;
  elapsed_ = 0.0;
  changed_ = extended_ = false;
  basis_.regressor(phase, rows_.data());
  basis_.slope(phase, rows_.data(), slope_.data());
  rows_.head(basis_.count()) *= amplitude_;
  slope_ *= amplitude_ * basis_.phase_rate(phase, tau_);
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const Forcing has = learned(d);
    const Forcing needs = needed(at, d);
    offset_(d) = at.position(d) - goal_(d);
    velocity_(d) = at.velocity(d);
    lag_(d) = join.method == Join::dmp3 ? (needs.value - has.value) / gains_.K : 0.0;
    f_start_(d) = has.value;
    if (join.method == Join::dmp2a || join.method == Join::dmp2j)
      correct(d, {needs.value - has.value, needs.rate - has.rate}, join);
  }
  if (changed_ || extended_) add_corrections(0.0, rows_.data(), f_start_);
  refresh_sample();
}

// Changes the weights, or adds to the forcing, so that what is missing is there at the present phase.
void Execution::correct(Eigen::Index d, Forcing missing, const JoinSettings& join) noexcept {
  if (!weights_hold(join)) {
    extended_ = true;
    extra_(d) = missing.value;
    extra_rate_(d) = join.method == Join::dmp2j ? missing.rate : 0.0;
    return;
  }
  changed_ = true;
  const auto row = rows_.head(basis_.count());
  auto change = change_.col(d);
  const double aa = row.squaredNorm();
  if (join.method == Join::dmp2j) {
    const double ab = row.dot(slope_);
    const double bb = slope_.squaredNorm();
    const double determinant = aa * bb - ab * ab;
    change = row * ((bb * missing.value - ab * missing.rate) / determinant) +
             slope_ * ((aa * missing.rate - ab * missing.value) / determinant);
  } else if (join.change == WeightChange::smallest) {
    change = row * (missing.value / aa);
  } else {
    Eigen::Index kernel = 0;
    if (join.change == WeightChange::strongest) row.cwiseAbs().maxCoeff(&kernel);
    change.setZero();
    change(kernel) = missing.value / row(kernel);
  }
}

bool Execution::weights_hold(const JoinSettings& join) const noexcept {
  if (kind() == Kind::discrete && phase_ < faded_phase) return false;
  const auto row = rows_.head(basis_.count());
  if (join.method == Join::dmp2j) {
    const double ab = row.dot(slope_);
    return ab * ab < (1.0 - least_angle2) * row.squaredNorm() * slope_.squaredNorm();
  }
  if (join.change == WeightChange::first)
    return std::abs(row(0)) > least_share * row.cwiseAbs().maxCoeff();
  return true;
}

Execution::Forcing Execution::learned(Eigen::Index d) const noexcept {
  const auto w = weights_.col(d);
  return {w.dot(rows_.head(basis_.count())), w.dot(slope_)};
}

Execution::Forcing Execution::needed(const Sample& at, Eigen::Index d) const noexcept {
  const double tau2 = tau_ * tau_;
  const double damping = tau_ * gains_.D;
  return {
      tau2 * at.acceleration(d) + damping * at.velocity(d) - gains_.K * (goal_(d) - at.position(d)),
      tau2 * at.jerk(d) + damping * at.acceleration(d) + gains_.K * at.velocity(d)};
}

double Execution::fade_time() const noexcept {
  return kind() == Kind::rhythmic ? M_PI * tau_ : 0.5 * tau_;
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
    add_corrections(middle, rows_.data(), f_middle_);
    add_corrections(elapsed_, rows_.data() + M, f_end_);
  }
  propagate(propagator_.Phi.data(), propagator_.Gamma.data(), stride, f_start_.data(),
            f_middle_.data(), f_end_.data(), offset_.data(), velocity_.data(), lag_.data());
  f_start_.swap(f_end_);
  refresh_sample();
}

void Execution::add_corrections(double elapsed, const double* row,
                                Eigen::VectorXd& f) const noexcept {
  const double s = elapsed / fade_time();
  if (extended_) f += fade_value(s) * extra_ + fade_time() * fade_rate(s) * extra_rate_;
  const double share = kind() == Kind::rhythmic ? fade_value(s) : 1.0;
  if (!changed_ || share == 0.0) return;
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
  const int M = basis_.count();
  const double s = elapsed_ / fade_time();
  const double share = kind() == Kind::rhythmic ? fade_value(s) : 1.0;
  const double share_rate = kind() == Kind::rhythmic ? fade_value_slope(s) / fade_time() : 0.0;
  basis_.regressor(phase_, rows_.data());
  basis_.slope(phase_, rows_.data(), slope_.data());
  rows_.head(M) *= amplitude_;
  slope_ *= amplitude_ * basis_.phase_rate(phase_, tau_);
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    double rate = learned(d).rate;
    if (changed_)
      rate += share * change_.col(d).dot(slope_) + share_rate * change_.col(d).dot(rows_.head(M));
    if (extended_)
      rate += fade_value_slope(s) / fade_time() * extra_(d) + fade_rate_slope(s) * extra_rate_(d);
    const double lag_rate = -gains_.H / tau_ * lag_(d);
    sample_.jerk(d) =
        (gains_.K * (lag_rate - velocity_(d)) - tau_ * gains_.D * sample_.acceleration(d) + rate) /
        (tau_ * tau_);
  }
  return sample_;
}

bool Execution::set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept {
  if (goal.size() != dimensions() || !goal.allFinite()) return false;
  const Sample& now = state();
  goal_.head(dimensions()) = goal;
  reinitialise(now, phase_, join_);
  return true;
}

bool Execution::set_tau(double tau) noexcept {
  if (!(std::isfinite(tau) && tau > 0.0)) return false;
  const Sample& now = state();
  tau_ = tau;
  dt_ = 0.0;
  reinitialise(now, phase_, join_);
  return true;
}

bool Execution::set_amplitude(double amplitude) noexcept {
  if (!std::isfinite(amplitude) || kind() != Kind::rhythmic) return false;
  const Sample& now = state();
  amplitude_ = amplitude;
  reinitialise(now, phase_, join_);
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
