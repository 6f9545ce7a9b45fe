// Execution's wishes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "responses.hpp"
#include "shown.hpp"
#include "vectors.hpp"
#include <seam/error.hpp>
#include <seam/execution.hpp>
#include <seam/quintic.hpp>

namespace seam {

namespace {

constexpr int orders = 4;  // y, ẏ, ÿ, y⃛
constexpr double least_share[orders] = {0.2, 0.2, 0.05,
                                        0.05};  // of a wish's row, outside of those before it
constexpr double independent = 1e-9;            // likewise of the join's rows
constexpr double over = 1e-9;                   // [s] a moment that is nearer has come
constexpr double free = std::numeric_limits<double>::quiet_NaN();
constexpr double never = std::numeric_limits<double>::infinity();

void assign_values(const Eigen::VectorXd& from, Eigen::VectorXd& to) {
  if (from.size() == 0)
    to.setConstant(free);
  else
    to = from;
}

// Weights times answers to them: all weights with each of three, the wishes' part with the first.
SEAM_WIDEST_VECTORS void answer(const double* weights, const double* by_wishes,
                                const double* answers, int M, int stride,
                                double* answered) noexcept {
  for (int d = 0; d < stride; d += lanes) {
    Lanes y{}, v{}, f{}, wished{};
    for (int j = 0; j < M; ++j) {
      const Lanes w = SEAM_CONST_LANES(weights + j * stride + d);
      y += answers[j] * w;
      v += answers[M + j] * w;
      f += answers[2 * M + j] * w;
      wished += answers[j] * SEAM_CONST_LANES(by_wishes + j * stride + d);
    }
    SEAM_LANES(answered + d) = y;
    SEAM_LANES(answered + stride + d) = v;
    SEAM_LANES(answered + 2 * stride + d) = f;
    SEAM_LANES(answered + 3 * stride + d) = wished;
  }
}

}  // namespace

void Execution::make_room(int stride) {
  const auto wishes = static_cast<Eigen::Index>(slots_.size());
  const Eigen::Index M = basis_.count();
  const Eigen::VectorXd nothing = Eigen::VectorXd::Constant(dimensions(), free);
  spare_.wish.position = spare_.wish.velocity = spare_.wish.acceleration = nothing;
  for (Slot& slot : slots_) slot = spare_;
  leave_ = nothing;
  begun_.setZero(M, 2);
  answers_.setZero(M, 3);
  answered_.setZero(stride, 4);
  rows_.setZero(M, orders * wishes);
  free_.setZero(stride, orders * wishes);
  flight_.setZero(stride, orders);
  missing_.setZero(stride, 2);
  delta_.setZero(stride, kernels());
  by_wishes_ = total_ = delta_;
  before_.setZero(stride, columns + kernels());
  price_.deviation.setZero(dimensions());
  price_.acceleration.setZero(dimensions());
  offer_ = price_;
}

void Execution::take(const std::vector<Wish>& wishes, const Eigen::VectorXd& leave) {
  const auto fits = [&](const Eigen::VectorXd& values) {
    return (values.size() == 0 || values.size() == dimensions()) && !values.array().isInf().any();
  };
  if (!fits(leave))
    throw Error("wish", "leave needs an acceleration per coordinate, finite or NaN");
  assign_values(leave, leave_);
  for (const Wish& wish : wishes) {
    const char* why = unusable(wish);
    if (*why != '\0') throw Error("wish " + std::to_string(given_ + 1), why);
    assign(given_++, wish);
  }
  wishes_ = given_;
}

void Execution::assign(int which, const Wish& wish) noexcept {
  Slot& slot = slots_[static_cast<std::size_t>(which)];
  slot.live = true;
  slot.wish.when = wish.when;
  slot.wish.then = wish.then;
  slot.wish.smooth = wish.smooth;
  assign_values(wish.position, slot.wish.position);
  assign_values(wish.velocity, slot.wish.velocity);
  assign_values(wish.acceleration, slot.wish.acceleration);
}

// Empty where there is nothing wrong.
const char* Execution::unusable(const Wish& wish) const noexcept {
  bool asks = wish.then == Wish::Then::stay;
  for (const Eigen::VectorXd* values : {&wish.position, &wish.velocity, &wish.acceleration}) {
    if (values->size() == 0) continue;
    if (values->size() != dimensions()) return "needs a value per coordinate, NaN where it is free";
    if (values->array().isInf().any()) return "has a value that is not finite";
    asks = asks || !values->array().isNaN().all();
  }
  if (!asks) return "wishes nothing, all its values are free";
  if (wish.then == Wish::Then::stay && kind() == Kind::rhythmic)
    return "a rhythmic primitive does not arrive";
  if (!std::isfinite(wish.when.value) || wish.when.when == Switch::When::near_goal ||
      wish.when.when == Switch::When::on_call ||
      (wish.when.when == Switch::When::before_end && kind() == Kind::rhythmic) ||
      (wish.when.when == Switch::When::cycles && kind() == Kind::discrete) ||
      (wish.when.when == Switch::When::at_phase && kind() == Kind::discrete &&
       !(wish.when.value > 0.0 && wish.when.value < 1.0)))
    return "has no moment that is known beforehand, must be at a time or at a phase";
  return "";
}

double Execution::due_in(const Wish& wish) const noexcept {
  const double time = passed_ + elapsed_;
  return due(wish.when, basis_, {tau_, time, phase_, phase_ - begin_phase_}) - time;
}

// When everything is that is still to come.
void Execution::schedule() noexcept {
  arrival_ = never;
  for (Slot& slot : slots_) {
    const double left = slot.live ? due_in(slot.wish) : 0.0;
    slot.left = left > over ? left : 0.0;
    if (slot.live && !stays_ && slot.wish.then == Wish::Then::stay) arrival_ = elapsed_ + slot.left;
  }
}

// What is wished of a coordinate, its velocity, acceleration or jerk; NaN where it is free.
double Execution::wished(std::size_t i, int order, Eigen::Index d) const noexcept {
  const Wish& wish = slots_[i].wish;
  const bool stays = wish.then == Wish::Then::stay;
  switch (order) {
    case 0:
      return stays ? at(target)(d) : wish.position(d);
    case 1:
      return stays ? 0.0 : wish.velocity(d);
    case 2:
      return stays && wish.smooth ? 0.0 : wish.acceleration(d);
    default:
      return stays && wish.smooth && join_.method == Join::dmp2j ? 0.0 : free;
  }
}

// The change of a rhythmic primitive's weights acts in full until the last wish.
void Execution::hold_off_fading() noexcept {
  if (kind() == Kind::discrete) return;
  double last = -never;
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (slots_[i].left > 0.0) last = std::max(last, phase_ + slots_[i].left / tau_);
  if (!(last > phase_)) return;
  if (fading_) change() *= fade(faded(phase_));
  fade_from_ = last;
}

bool Execution::refuse(std::size_t i, const char* why) noexcept {
  refused_ = i;
  refusal_ = why;
  return false;
}

// Whether anything is to come.
bool Execution::asked() const noexcept {
  return std::any_of(slots_.begin(), slots_.end(),
                     [](const Slot& slot) { return slot.left > 0.0; });
}

// Δw, for the join and for all wishes that are to come.
bool Execution::find_changes() noexcept {
  if (asked() && !evaluate_rows()) return false;
  if (asked() || !missing_.isZero(0.0)) {
    by_wishes_.setZero();
    for (Eigen::Index d = 0; d < dimensions(); ++d) {
      if ((d == 0 || !asks_as(d, d - 1)) && !gather(d)) return false;
      find_change(d);
    }
  }
  return true;
}

bool Execution::asks_as(Eigen::Index d, Eigen::Index other) const noexcept {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (!(slots_[i].left > 0.0)) continue;
    for (int order = 0; order < orders; ++order)
      if (std::isnan(wished(i, order, d)) != std::isnan(wished(i, order, other))) return false;
  }
  return true;
}

// For every wish that is to come, how the motion then answers to the weights, and what it is without them.
bool Execution::evaluate_rows() noexcept {
  const double from = responses_->at_phase(phase_);
  if (!responses_->cover(from)) return refuse(0, "comes after weights have lost their hold");
  responses_->state(from, begun_, answers_.col(0));
  const double K = gains_.K, D = gains_.D * tau_, square = tau_ * tau_;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (!(slots_[i].left > 0.0)) continue;
    const double left = slots_[i].left;
    const double to = from + left / tau_;
    if (kind() == Kind::rhythmic && phase_ + left / tau_ > begin_phase_ + 2.0 * M_PI * (1.0 + over))
      return refuse(i, "comes after the cycle that is entered");
    if (left > arrival_ - elapsed_ + over) return refuse(i, "comes after the arrival");
    if (!responses_->cover(to)) return refuse(i, "comes after weights have lost their hold");
    const auto column = static_cast<Eigen::Index>(orders * i);
    auto rows = rows_.middleCols<orders>(column);
    responses_->rows(from, begun_, to, rows);
    rows *= amplitude_;
    const Propagator flight(gains_, tau_, left);
    flight_ = hot_.middleCols<orders>(offset).lazyProduct(flight.Phi.transpose());
    auto free = free_.middleCols<orders>(column);
    free.leftCols<2>() = flight_.leftCols<2>();
    free.col(2) = (flight_.col(2) - K * free.col(0) - D * free.col(1)) / square;
    free.col(3) = (flight_.col(3) - K * free.col(1) - D * free.col(2)) / square;
    free.col(0) += at(target);
  }
  return true;
}

// The conditions on a coordinate's weights: the join's first.
bool Execution::gather(Eigen::Index d) noexcept {
  conditions_.clear();
  conditions_.add(row_.transpose(), independent);
  if (join_.method == Join::dmp2j) conditions_.add(slope_.transpose(), independent);
  join_rows_ = conditions_.count();
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (!(slots_[i].left > 0.0)) continue;
    for (int order = 0; order < orders; ++order) {
      const auto column = static_cast<Eigen::Index>(orders * i) + order;
      if (std::isnan(wished(i, order, d))) continue;
      if (conditions_.add(rows_.col(column), least_share[order])) continue;
      return refuse(i,
                    "asks too much of the kernels: it is too near to the beginning or to another "
                    "wish, or they contradict "
                    "each other, or weights have lost their hold, or there are too few kernels");
    }
  }
  return true;
}

void Execution::find_change(Eigen::Index d) noexcept {
  for (int row = 0; row < join_rows_; ++row) conditions_.meet(row, missing_(d, row));
  int row = join_rows_;
  for (std::size_t i = 0; i < slots_.size() && row < conditions_.count(); ++i) {
    if (!(slots_[i].left > 0.0)) continue;
    for (int order = 0; order < orders; ++order)
      if (!std::isnan(wished(i, order, d))) conditions_.meet(row++, right_side(i, order, d));
  }
  const int M = basis_.count();
  by_wishes_.row(d).head(M) = conditions_.change(join_rows_, row);
  delta_.row(d).head(M) += conditions_.change(0, join_rows_);
  delta_.row(d) += by_wishes_.row(d);
}

// What is still missing of a wish, in units of τ.
double Execution::right_side(std::size_t i, int order, Eigen::Index d) const noexcept {
  const auto column = static_cast<Eigen::Index>(orders * i) + order;
  const auto row = rows_.col(column);
  const int M = basis_.count();
  double comes = row.dot(weights().row(d).head(M)) + row.dot(delta_.row(d).head(M));
  if (kind() == Kind::rhythmic) comes += row.dot(change().row(d).head(M));
  return std::pow(tau_, order) * (wished(i, order, d) - free_(d, column)) - comes;
}

// Looks at the points of the table of responses, until the last wish or tau. What was found has not been done yet.
void Execution::estimate(Price& price) noexcept {
  price.possible = true;
  price.deviation.setZero();
  price.acceleration.setZero();
  if (!asked()) return;
  const double from = responses_->at_phase(phase_);
  double end = kind() == Kind::discrete ? 1.0 : 0.0;
  for (const Slot& slot : slots_) end = std::max(end, from + slot.left / tau_);
  total_ = weights() + delta_;
  if (kind() == Kind::rhythmic) total_ += change();
  flight_ = hot_.middleCols<orders>(offset);
  answered_.setZero();
  answered_.col(2) = at(f_start);
  keep_worst(price);
  const double panel = responses_->panel();
  int point = static_cast<int>(from / panel) + 1;
  Propagator flight(gains_, tau_, (point * panel - from) * tau_);
  const Propagator next(gains_, tau_, panel * tau_);
  for (; (point - 0.5) * panel < end && point <= responses_->panels(); ++point) {
    for (Eigen::Index d = 0; d < flight_.rows(); ++d) {
      const Eigen::RowVector4d before = flight_.row(d);
      flight_.row(d).noalias() = before * flight.Phi.transpose();
    }
    flight = next;
    responses_->at_point(point, from, begun_, answers_);
    answers_ *= amplitude_;
    answer(total_.data(), by_wishes_.data(), answers_.data(), basis_.count(),
           static_cast<int>(total_.rows()), answered_.data());
    keep_worst(price);
  }
}

void Execution::keep_worst(Price& price) const noexcept {
  for (Eigen::Index d = 0; d < dimensions(); ++d) {
    const double f = answered_(d, 2) + flight_(d, 2);
    const double y = answered_(d, 0) + flight_(d, 0);
    const double v = answered_(d, 1) + tau_ * flight_(d, 1);
    const double acceleration = std::abs(f - gains_.K * y - gains_.D * v) / (tau_ * tau_);
    const double deviation = std::abs(answered_(d, 3));
    price.acceleration(d) = std::max(price.acceleration(d), acceleration);
    price.deviation(d) = std::max(price.deviation(d), deviation);
  }
}

bool Execution::may_set(int which, const Wish& wish) const noexcept {
  return which >= 0 && which <= wishes_ && which < static_cast<int>(slots_.size()) && !stays_ &&
         *unusable(wish) == '\0' && due_in(wish) > over;
}

bool Execution::set_wish(int which, const Wish& wish) noexcept {
  if (!may_set(which, wish)) return false;
  Slot& slot = slots_[static_cast<std::size_t>(which)];
  spare_ = slot;
  const Sample& now = remember();
  assign(which, wish);
  if (go_on_or_back(now)) {
    wishes_ = std::max(wishes_, which + 1);
    return true;
  }
  slot = spare_;
  schedule();
  return false;
}

const Price& Execution::price_of(int which, const Wish& wish) noexcept {
  offer_.possible = false;
  if (!may_set(which, wish)) return offer_;
  Slot& slot = slots_[static_cast<std::size_t>(which)];
  spare_ = slot;
  const Sample& now = remember();
  assign(which, wish);
  if (find_from(now, phase_, false)) estimate(offer_);
  slot = spare_;
  go_back();
  return offer_;
}

void Execution::drop_wishes() noexcept {
  for (Slot& slot : slots_) slot.live = false;
  schedule();
}

// At the goal: from here on there is no forcing but what may be missing for the acceleration, which dies out.
void Execution::arrive() noexcept {
  refresh_sample();
  const Sample& now = state();
  stays_ = true;
  weights().setZero();
  find_from(now, phase_, false);
  go_on();
}

// After a coupling has let go.
void Execution::wish_anew() noexcept {
  schedule();
  if (!asked()) return;
  const Sample& now = remember();
  if (!go_on_or_back(now)) wishes_hold_ = false;
}

void Execution::require_possible(double phase, const JoinSettings& join) {
  Sample start = sample_;
  reinitialise(start, phase, join);
  if (!wishes_hold_) throw Error("wish " + std::to_string(refused_ + 1), refusal_);
  for (int i = 0; i < given_; ++i) {
    const Slot& slot = slots_[static_cast<std::size_t>(i)];
    if (slot.left > 0.0) continue;
    throw Error("wish " + std::to_string(i + 1), "its moment is " + shown(due_in(slot.wish)) +
                                                     " s after the beginning, must be > 0");
  }
}

}  // namespace seam
