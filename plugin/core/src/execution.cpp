#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "responses.hpp"
#include "vectors.hpp"
#include <seam/execution.hpp>
#include <seam/quintic.hpp>

namespace seam {

namespace {

constexpr double faded_phase = 0.05;  // x below which weights have lost their hold
constexpr double least_share =
    0.1;  // of the first kernel against the strongest, to be changed alone

const Primitive& valid(const Primitive& primitive) {
  primitive.validate();
  return primitive;
}

constexpr int fading_parts = 4;  // of a step, while changed weights bend the forcing most

// What is smaller is nothing: numbers that the processor holds only slowly never come about.
constexpr double least_magnitude = 1e-200;

SEAM_INLINE void flush(Lanes& v) {
  const Lanes magnitude = v < 0.0 ? -v : v;
  v = magnitude > least_magnitude ? v : Lanes{};
}

// s ← Φs + Γ(f₀, f_m, f₁)ᵀ and f₀ ← f₁ for every coordinate; matrices by columns.
SEAM_WIDEST_VECTORS void propagate(const double* P, const double* G, int stride, double* f0,
                                   const double* fm, const double* f1, double* offset,
                                   double* velocity, double* added, double* added_rate) noexcept {
  for (int d = 0; d < stride; d += lanes) {
    const Lanes y = SEAM_CONST_LANES(offset + d);
    const Lanes v = SEAM_CONST_LANES(velocity + d);
    const Lanes e = SEAM_CONST_LANES(added + d);
    const Lanes ed = SEAM_CONST_LANES(added_rate + d);
    const Lanes start = SEAM_CONST_LANES(f0 + d);
    const Lanes middle = SEAM_CONST_LANES(fm + d);
    const Lanes end = SEAM_CONST_LANES(f1 + d);
    Lanes next_y = (P[0] * y + P[4] * v) + (P[8] * e + P[12] * ed) +
                   ((G[0] * start + G[2] * middle) + G[4] * end);
    Lanes next_v = (P[1] * y + P[5] * v) + (P[9] * e + P[13] * ed) +
                   ((G[1] * start + G[3] * middle) + G[5] * end);
    Lanes next_e = P[10] * e + P[14] * ed;
    Lanes next_ed = P[11] * e + P[15] * ed;
    flush(next_y);
    flush(next_v);
    flush(next_e);
    flush(next_ed);
    SEAM_LANES(offset + d) = next_y;
    SEAM_LANES(velocity + d) = next_v;
    SEAM_LANES(added + d) = next_e;
    SEAM_LANES(added_rate + d) = next_ed;
    SEAM_LANES(f0 + d) = end;
  }
}

SEAM_WIDEST_VECTORS void observe(double k, double c, double b, int D, const double* __restrict goal,
                                 const double* __restrict offset, const double* __restrict velocity,
                                 const double* __restrict added, const double* __restrict forcing,
                                 double* __restrict y, double* __restrict yd,
                                 double* __restrict ydd) noexcept {
  for (int d = 0; d < D; ++d) {
    y[d] = goal[d] + offset[d];
    yd[d] = velocity[d];
    ydd[d] = b * (forcing[d] + added[d]) - k * offset[d] - c * velocity[d];
  }
}

}  // namespace

Execution::Execution(const Primitive& primitive, const std::vector<Wish>& wishes,
                     const Eigen::VectorXd& leave)
    : gains_(valid(primitive).gains),
      tau_(primitive.tau),
      basis_(primitive),
      sample_(primitive.dimensions()),
      responses_(std::make_shared<Responses>(primitive)),
      slots_(std::max<std::size_t>(most_wishes, wishes.size())),
      conditions_(basis_.count(), 2 + 4 * static_cast<int>(slots_.size())) {
  const int D = primitive.dimensions();
  const int M = basis_.count();
  const int stride = padded(D);
  hot_.setZero(stride, columns + padded(M));
  cold_.setZero(stride, rare_columns + 2 * padded(M));
  learned().topLeftCorner(D, M) = primitive.weights.transpose();
  at(target).head(D) = primitive.goal;
  row_.setZero(M);
  slope_.setZero(M);
  make_room(stride);
  Sample start(D);
  start.position = primitive.start_position;
  start.velocity = primitive.start_velocity;
  reinitialise(start, basis_.start_phase(), Join::dmp2);
  take(wishes, leave);
}

void Execution::reinitialise(const Sample& from, double phase, const JoinSettings& join) noexcept {
  join_ = join;
  begin_phase_ = phase;
  passed_ = 0.0;
  elapsed_ = 0.0;
  stays_ = false;
  wishes_hold_ = true;
  wishes_ = given_;
  for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i].live = static_cast<int>(i) < given_;
  begin_from(from, phase);
  for (int i = 0; i < given_; ++i)
    if (due_in(slots_[static_cast<std::size_t>(i)].wish) <= 0.0)
      wishes_hold_ = price_.possible = false;
}

void Execution::resume(const Sample& from) noexcept {
  begin_from(from, phase_);
}

void Execution::begin_from(const Sample& from, double phase) noexcept {
  fade_from_ = phase;
  fading_ = false;
  if (stays_)
    weights().setZero();
  else
    weights() = learned();
  change().setZero();
  at(added).setZero();
  at(added_rate).setZero();
  if (find_from(from, phase, true)) {
    estimate(price_);
    price_.possible = wishes_hold_;
    return go_on();
  }
  wishes_hold_ = false;
  slots_[refused_].live = false;
  begin_from(from, phase);
}

// Finds what it takes to continue from a state: what is missing of the forcing is made up for as the method says. At a join
// by the weights if they hold, on the way of a rhythmic primitive by a forcing that is added and dies out.
bool Execution::find_from(const Sample& from, double phase, bool at_join) noexcept {
  passed_ += elapsed_;
  elapsed_ = 0.0;
  entry_phase_ = phase_ = phase;
  schedule();
  hold_off_fading();
  evaluate_regressor();
  const bool enters = at_join && passed_ == 0.0;
  measure_coupling(from);
  measure_coupling_rate(from);
  const bool by_weights = weights_hold() && (at_join || kind() == Kind::discrete);
  missing_.setZero();
  delta_.setZero();
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const bool leaves = enters && !std::isnan(leave_(d));
    const Forcing has = present(d);
    const Forcing needs = needed(from, leaves ? leave_(d) : from.acceleration(d), d);
    at(offset)(d) = from.position(d) - at(target)(d);
    at(velocity)(d) = from.velocity(d);
    at(f_start)(d) = has.value;
    if (join_.method == Join::dmp2 && !leaves) continue;
    make_up_for(d,
                {needs.value - has.value - at(added)(d), needs.rate - has.rate - at(added_rate)(d)},
                by_weights);
  }
  return find_changes();
}

void Execution::make_up_for(Eigen::Index d, Forcing missing, bool by_weights) noexcept {
  if (join_.method == Join::dmp3 || !by_weights) {
    at(added)(d) += missing.value;
    if (join_.method == Join::dmp3) at(added_rate)(d) = -gains_.H / tau_ * at(added)(d);
    if (join_.method == Join::dmp2j) at(added_rate)(d) += missing.rate;
    return;
  }
  at(f_start)(d) += missing.value;
  if (join_.method != Join::dmp2a || join_.change == WeightChange::smallest) {
    missing_.row(d) << missing.value, missing.rate;
    return;
  }
  Eigen::Index kernel = 0;
  if (join_.change == WeightChange::strongest) row_.cwiseAbs().maxCoeff(&kernel);
  delta_(d, kernel) = missing.value / row_(kernel);
}

// Does what was found.
void Execution::go_on() noexcept {
  if (kind() == Kind::discrete) {
    weights() += delta_;
  } else {
    change() += delta_;
    fading_ = fading_ || !delta_.isZero(0.0);
  }
  if (coupled_.coupling) at(f_start).head(dimensions()) += tau_ * tau_ * coupled_.value;
  refresh_sample();
}

const Sample& Execution::remember() noexcept {
  schedule();
  pending_before_ = pending();
  before_ << hot_.leftCols<columns>(), change();
  tau_before_ = tau_;
  amplitude_before_ = amplitude_;
  fade_from_before_ = fade_from_;
  fading_before_ = fading_;
  return state();
}

bool Execution::go_on_or_back(const Sample& now) noexcept {
  if (find_from(now, phase_, false) && pending() >= pending_before_) return go_on(), true;
  go_back();
  return false;
}

void Execution::go_back() noexcept {
  hot_.leftCols<columns>() = before_.leftCols<columns>();
  change() = before_.rightCols(kernels());
  tau_ = tau_before_;
  amplitude_ = amplitude_before_;
  fade_from_ = fade_from_before_;
  fading_ = fading_before_;
  dt_ = std::numeric_limits<double>::quiet_NaN();
  schedule();
}

bool Execution::weights_hold() const noexcept {
  if (stays_) return false;
  if (kind() == Kind::discrete && phase_ < faded_phase) return false;
  const double aa = row_.squaredNorm();
  if (!(aa > 1e-12)) return false;
  if (join_.method == Join::dmp2j) {
    const double own_rate =
        basis_.phase_rate(phase_, tau_) / (kind() == Kind::discrete ? phase_ : 1.0);
    const double ab = row_.dot(slope_);
    return aa * slope_.squaredNorm() - ab * ab >= aa * aa * own_rate * own_rate;
  }
  if (join_.change == WeightChange::first)
    return std::abs(row_(0)) > least_share * row_.cwiseAbs().maxCoeff();
  return true;
}

// a(p) and ȧ at the present phase, with the amplitude.
void Execution::evaluate_regressor() noexcept {
  basis_.regressor(phase_, row_.data());
  basis_.slope(phase_, row_.data(), slope_.data());
  row_ *= amplitude_;
  slope_ *= amplitude_ * basis_.phase_rate(phase_, tau_);
}

// The forcing of the weights and its rate as they are: learned, changed and fading.
Execution::Forcing Execution::present(Eigen::Index d) const noexcept {
  const auto weights = this->weights().row(d).head(basis_.count());
  Forcing f{weights.dot(row_), weights.dot(slope_)};
  if (!fading_) return f;
  const auto change = this->change().row(d).head(basis_.count());
  const double share = fade(faded(phase_));
  const double slope = fade_slope(faded(phase_)) * basis_.phase_rate(phase_, tau_) / M_PI;
  f.value += share * change.dot(row_);
  f.rate += share * change.dot(slope_) + slope * change.dot(row_);
  return f;
}

// How much of the half cycle has gone by in which a rhythmic primitive's change fades.
double Execution::faded(double phase) const noexcept {
  return std::clamp((phase - fade_from_) / M_PI, 0.0, 1.0);
}

Execution::Forcing Execution::needed(const Sample& from, double acceleration,
                                     Eigen::Index d) const noexcept {
  const double tau2 = tau_ * tau_;
  const double damping = tau_ * gains_.D;
  Forcing needs{tau2 * acceleration + damping * from.velocity(d) -
                    gains_.K * (at(target)(d) - from.position(d)),
                tau2 * from.jerk(d) + damping * acceleration + gains_.K * from.velocity(d)};
  if (coupled_.coupling)
    needs.value -= tau2 * coupled_.value(d), needs.rate -= tau2 * coupled_.rate(d);
  return needs;
}

void Execution::step(double dt) noexcept {
  if (arrival_ - elapsed_ <= dt) {
    const double left = std::max(0.0, arrival_ - elapsed_);
    advance(left);
    arrive();
    dt -= left;
  }
  const bool pushed = coupled_.coupling && !coupled_.value.isZero(0.0);
  const bool bends = fading_ && basis_.advance(phase_, dt, tau_) > fade_from_;
  const int parts = bends ? fading_parts : 1;
  for (int i = 0; i < parts; ++i) advance(dt / parts);
  refresh_sample();
  if (pushed) after_a_push(dt);
}

void Execution::advance(double dt) noexcept {
  if (dt != dt_) set_step(dt);
  const int stride = static_cast<int>(hot_.rows());
  const double middle = kind() == Kind::discrete ? phase_ * half_step_ : phase_ + half_step_;
  elapsed_ += dt;
  phase_ = basis_.advance(entry_phase_, elapsed_, tau_);
  basis_.forcing(middle, phase_, weights().data(), stride, at(f_middle).data(), at(f_end).data());
  if (fading_) add_fading(middle);
  if (amplitude_ != 1.0) at(f_middle) *= amplitude_, at(f_end) *= amplitude_;
  const bool coupled = coupled_.coupling != nullptr;
  if (coupled) predict_coupling(dt);
  propagate(propagator_.Phi.data(), propagator_.Gamma.data(), stride, at(f_start).data(),
            at(f_middle).data(), at(f_end).data(), at(offset).data(), at(velocity).data(),
            at(added).data(), at(added_rate).data());
  if (coupled) finish_coupling(dt);
}

void Execution::add_fading(double middle) noexcept {
  basis_.forcing(middle, phase_, change().data(), static_cast<int>(cold_.rows()),
                 at(faded_middle).data(), at(faded_end).data());
  at(f_middle) += fade(faded(middle)) * at(faded_middle);
  at(f_end) += fade(faded(phase_)) * at(faded_end);
  fading_ = faded(phase_) < 1.0;
  if (!fading_) change().setZero();
}

void Execution::set_step(double dt) noexcept {
  dt_ = dt;
  half_step_ = basis_.advance(basis_.start_phase(), 0.5 * dt, tau_);
  propagator_ = Propagator(gains_, tau_, dt);
  set_coupled_step(dt);
}

void Execution::refresh_sample() noexcept {
  observe(gains_.K / (tau_ * tau_), gains_.D / tau_, 1.0 / (tau_ * tau_), dimensions(),
          at(target).data(), at(offset).data(), at(velocity).data(), at(added).data(),
          at(f_start).data(), sample_.position.data(), sample_.velocity.data(),
          sample_.acceleration.data());
}

const Sample& Execution::state() noexcept {
  evaluate_regressor();
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    sample_.jerk(d) = (present(d).rate + at(added_rate)(d) - gains_.K * at(velocity)(d) -
                       tau_ * gains_.D * sample_.acceleration(d)) /
                      (tau_ * tau_);
  }
  measure_coupling_rate(sample_);
  if (coupled_.coupling) sample_.jerk += coupled_.rate;
  return sample_;
}

bool Execution::set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept {
  if (goal.size() != dimensions() || !goal.allFinite()) return false;
  if (goal == this->goal()) return true;
  const Sample& now = remember();
  at(target).head(dimensions()) = goal;
  return go_on_or_back(now);
}

bool Execution::set_tau(double tau) noexcept {
  if (!(tau >= tau_bounds.least && tau <= tau_bounds.largest)) return false;
  if (tau == tau_) return true;
  const Sample& now = remember();
  tau_ = tau;
  dt_ = std::numeric_limits<double>::quiet_NaN();
  return go_on_or_back(now);
}

bool Execution::set_amplitude(double amplitude) noexcept {
  if (!std::isfinite(amplitude) || kind() != Kind::rhythmic) return false;
  if (amplitude == amplitude_) return true;
  const Sample& now = remember();
  amplitude_ = amplitude;
  return go_on_or_back(now);
}

double Execution::correction(const Sample& from, double phase) noexcept {
  basis_.regressor(phase, row_.data());
  measure_coupling(from);
  double sum = 0.0;
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const double has = amplitude_ * learned().row(d).head(basis_.count()).dot(row_);
    const double missing = needed(from, from.acceleration(d), d).value - has;
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
