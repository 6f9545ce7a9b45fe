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
constexpr double least_ahead = 1e-3;            // of tau: nearer, rows are rounding
constexpr double over = 1e-9;                   // [s] a moment that is nearer has come
constexpr double free = std::numeric_limits<double>::quiet_NaN();
constexpr const char* too_much =
    "asks too much of the kernels: it is too near to the beginning or to another "
    "wish, or they contradict "
    "each other, or weights have lost their hold, or there are too few kernels";
constexpr const char* after_cycle = "comes after the cycle that is entered";
constexpr const char* faded_out = "comes after weights have lost their hold";
constexpr const char* no_table =
    "cannot be met: there are too many kernels, or kernels or gains are too sharp";
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
    require_ahead(wish);
    for (int i = 0; i < given_; ++i)
      if (wish.then != Wish::Then::go_on &&
          slots_[static_cast<std::size_t>(i)].wish.then == wish.then)
        throw Error("wish " + std::to_string(given_ + 1), wish.then == Wish::Then::stay
                                                              ? "arrives for a second time"
                                                              : "hands over for a second time");
    assign(given_++, wish);
  }
  wishes_ = given_;
}

// What can be known before the phase is at which a primitive is entered.
void Execution::require_ahead(const Wish& wish) const {
  const std::string place = "wish " + std::to_string(given_ + 1);
  const bool timed = wish.when.when == Switch::When::after;
  if (!timed && wish.when.when != Switch::When::cycles) return;
  if (!(wish.when.value > 0.0))
    throw Error(place,
                "its moment is " + shown(wish.when.value) + " after the beginning, must be > 0");
  const double cycles = timed ? wish.when.value / (2.0 * M_PI * tau_) : wish.when.value;
  if (kind() == Kind::rhythmic && cycles > 1.0 + over) throw Error(place, after_cycle);
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
  if (wish.then == Wish::Then::stay &&
      wish.position.size() + wish.velocity.size() + wish.acceleration.size() > 0)
    return "arrives at the goal and at rest, must have no values of its own";
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
    slot.due = elapsed_ + slot.left;
    if (slot.live && !stays_ && slot.wish.then == Wish::Then::stay) arrival_ = slot.due;
  }
}

int Execution::pending() const noexcept {
  return static_cast<int>(std::count_if(slots_.begin(), slots_.end(),
                                        [](const Slot& slot) { return slot.left > 0.0; }));
}

double Execution::last_moment(int but) const noexcept {
  double last = 0.0;
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (static_cast<int>(i) != but && slots_[i].left > 0.0 && slots_[i].due > elapsed_)
      last = std::max(last, passed_ + slots_[i].due);
  return last;
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
  return pending() > 0;
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
  const auto first = static_cast<std::size_t>(
      std::find_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.left > 0.0; }) -
      slots_.begin());
  if (!responses_->cover(from))
    return refuse(first, responses_->panels() > 0 ? faded_out : no_table);
  responses_->state(from, begun_, answers_.col(0));
  const double K = gains_.K, D = gains_.D * tau_, square = tau_ * tau_;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (!(slots_[i].left > 0.0)) continue;
    const double left = slots_[i].left;
    const double to = from + left / tau_;
    if (kind() == Kind::rhythmic && phase_ + left / tau_ > begin_phase_ + 2.0 * M_PI * (1.0 + over))
      return refuse(i, after_cycle);
    if (left < least_ahead * tau_) return refuse(i, too_much);
    if (left > arrival_ - elapsed_ + over) return refuse(i, "comes after the arrival");
    if (!responses_->cover(to)) return refuse(i, faded_out);
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
      return refuse(i, too_much);
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

// There is one wish that hands over and one that arrives, and they remain so.
bool Execution::may_set(int which, const Wish& wish) const noexcept {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const bool same = slots_[i].wish.then == wish.then;
    const bool comes = slots_[i].live && due_in(slots_[i].wish) > over;
    if (static_cast<int>(i) == which ? comes && !same
                                     : comes && same && wish.then != Wish::Then::go_on)
      return false;
  }
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
  offer_.deviation.setZero();
  offer_.acceleration.setZero();
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
  if (coupled_.coupling && !coupled_.value.isZero(0.0)) wishes_hold_ = false;
  stays_ = true;
  weights().setZero();
  find_from(now, phase_, false);
  go_on();
}

// While a coupling acts nothing is met; after it has let go the wishes are solved anew.
void Execution::after_a_push(double dt) noexcept {
  for (const Slot& slot : slots_)
    if (slot.left > 0.0 && slot.due <= elapsed_ && slot.due > elapsed_ - dt) wishes_hold_ = false;
  if (coupled_.value.isZero(0.0)) wish_anew();
}

// Without those that can no longer be met.
void Execution::wish_anew() noexcept {
  const Sample& now = remember();
  if (pending_before_ == 0 || go_on_or_back(now)) return;
  wishes_hold_ = false;
  slots_[refused_].live = false;
  wish_anew();
}

void Execution::require_possible(double phase, const JoinSettings& join) {
  Sample start = sample_;
  refusal_ = "";
  reinitialise(start, phase, join);
  if (*refusal_ != '\0') throw Error("wish " + std::to_string(refused_ + 1), refusal_);
  for (int i = 0; i < given_; ++i) {
    const double left = due_in(slots_[static_cast<std::size_t>(i)].wish);
    if (!(left > over))
      throw Error("wish " + std::to_string(i + 1),
                  "its moment is " + shown(left) + " s after the beginning, must be > 0");
  }
}

}  // namespace seam
