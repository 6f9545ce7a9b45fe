#include <algorithm>
#include <cmath>
#include <limits>

#include <seam/error.hpp>
#include <seam/orientation.hpp>
#include <seam/sequencer.hpp>

namespace seam {

namespace {

// Two times closer than this share of a step are the same tick.
constexpr double same_tick = 1e-6;
constexpr double most_slack = 1e-9;  // [s]
constexpr double never = std::numeric_limits<double>::infinity();

// In place of a rhythmic primitive a discrete one without forcing: it settles at the goal.
std::optional<Execution> rest_of(const Primitive& primitive) {
  if (primitive.kind == Kind::discrete) return std::nullopt;
  Primitive rest = primitive;
  rest.kind = Kind::discrete;
  rest.kernels = Kernels::even_in_time(10, 0.75, rest.alpha);
  rest.weights.setZero(rest.kernels.count(), rest.dimensions());
  rest.tau = std::min(M_PI * primitive.tau, tau_bounds.largest);
  return Execution(rest);
}

Execution made(const Sequence::Step& step, std::size_t index, const JoinSettings& join) {
  Execution execution(step.primitive, step.wishes, step.leave);
  const double phase = phase_of(step.entry, execution.basis());
  if (step.wishes.empty() || std::isnan(phase)) return execution;
  try {
    execution.require_possible(phase, join);
  } catch (const Error& error) {
    throw Error("sequencer",
                "primitive " + std::to_string(index + 1) + ": " + std::string(error.what()));
  }
  return execution;
}

class CouplingSum : public Coupling {
 public:
  explicit CouplingSum(std::vector<std::shared_ptr<Coupling>> parts) : parts_(std::move(parts)) {}
  void add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
           Eigen::VectorXd& ydd) const noexcept override {
    for (const auto& part : parts_) part->add(y, yd, t, ydd);
  }

 private:
  std::vector<std::shared_ptr<Coupling>> parts_;
};

// When a switch or a wish is due [s] of what runs, since it began.
double moment_of(const Switch& when, const Execution& now, double own_time, double entry_phase) {
  return due(when, now.basis(), {now.tau(), own_time, now.phase(), now.phase() - entry_phase});
}

bool usable(const Sample& at, int dimensions) {
  for (const Eigen::VectorXd* part : {&at.position, &at.velocity, &at.acceleration, &at.jerk})
    if (part->size() != dimensions || !part->allFinite()) return false;
  return true;
}

}  // namespace

Sequencer::Sequencer(const Sequence& sequence, const JoinSettings& join, const Sample& start)
    : join_(join),
      start_(start),
      start_delay_(sequence.start_delay()),
      coordinates_(sequence.coordinates()),
      reference_(sequence.steps().front().primitive.reference_orientation),
      scaled_(start) {
  if (static_cast<std::size_t>(start.position.size()) != coordinates_.size())
    throw Error("sequencer", "start has " + std::to_string(start.position.size()) +
                                 " coordinates, the sequence " +
                                 std::to_string(coordinates_.size()));
  if (!usable(start, dimensions())) throw Error("sequencer", "start is not finite");
  const bool at_rest =
      start.velocity.isZero(0.0) && start.acceleration.isZero(0.0) && start.jerk.isZero(0.0);
  if (start_delay_ > 0.0 && !at_rest)
    throw Error("sequencer", "start moves, must be at rest where the first primitive is delayed");
  push(sequence);
  nothing_runs_ = price();
  nothing_runs_.possible = false;
  due_ = start_delay_;
  Execution& first = items_.front().execution;
  const double phase = phase_of(items_.front().entry, first.basis());
  if (start_delay_ > 0.0 && !std::isnan(phase)) first.reinitialise(start_, phase, join_);
  if (start_delay_ == 0.0) switch_over();
}

void Sequencer::require_joinable(const Sequence& sequence) const {
  if (sequence.coordinates() != coordinates_)
    throw Error("sequencer", "the coordinates that are added differ from those that are there");
  require_same_reference("sequencer", reference_,
                         sequence.steps().front().primitive.reference_orientation);
}

void Sequencer::forget_played() {
  for (; first_ < running_; ++first_) items_.pop_front();
  for (; first_join_ < joins_ - kept_joins; ++first_join_) events_.pop_front();
}

void Sequencer::push(const Sequence& sequence) {
  require_joinable(sequence);
  forget_played();
  for (std::size_t i = 0; i < sequence.steps().size(); ++i) {
    const Sequence::Step& step = sequence.steps()[i];
    items_.push_back({made(step, i, join_), rest_of(step.primitive), step.until, step.entry});
    if (coupling_) couple(items_.back());
  }
  JoinEvent event;
  event.price = items_.front().execution.price();
  event.acceleration_before.setZero(dimensions());
  event.acceleration_after = event.jerk_before = event.jerk_after = event.acceleration_before;
  const int expected = joins_ + to_come() + 1;  // one more for settling at the end
  events_.resize(static_cast<std::size_t>(expected - first_join_), event);
}

void Sequencer::append(const Sequence& sequence) {
  push(sequence);
  ++changes_;
  if (!finished_) return;
  finished_ = false;
  switch_over();
  rescale();
}

void Sequencer::replace(const Sequence& sequence) {
  require_joinable(sequence);
  clear();
  append(sequence);
}

void Sequencer::clear() noexcept {
  while (to_come() > 0) items_.pop_back();
}

void Sequencer::step(double dt) noexcept {
  advance(dt, scale_.advance(dt));
  if (near_goal()) switch_over();
  rescale();
}

void Sequencer::rescale() noexcept {
  if (scale_.is_real_time()) return;
  const double rate = scale_.rate();
  scaled_.position = motion().position;
  scaled_.velocity = rate * motion().velocity;
  scaled_.acceleration =
      rate * rate * motion().acceleration + scale_.rate_change() * motion().velocity;
}

const Sample& Sequencer::state() noexcept {
  const Sample& motion = running_ < 0 ? start_ : now().state();
  if (scale_.is_real_time()) return motion;
  const double rate = scale_.rate();
  scaled_.jerk = rate * rate * rate * motion.jerk +
                 3.0 * rate * scale_.rate_change() * motion.acceleration +
                 scale_.rate_curvature() * motion.velocity;
  return scaled_;
}

// By a time of the motion, in which real time advances by dt.
void Sequencer::advance(double dt, double time) noexcept {
  const double slack = std::min(same_tick * time, most_slack);
  double left = time;
  while (left > 0.0) {
    const double until_due = due() - own_time_;
    const double h = until_due < left - slack ? std::max(until_due, 0.0) : left;
    if (running_ >= 0 && h > 0.0) now().step(h);
    own_time_ += h;
    behind_ += (dt - time) * h / time;
    left -= h;
    if (until_due <= h + slack) {
      if (own_time_ - due() < slack) own_time_ = due();
      switch_over();
    }
  }
  if (time == 0.0) behind_ += dt;
}

double Sequencer::due() const noexcept {
  return finished_ ? never : due_;
}

// After what moves the switch: entering, a change of tau.
void Sequencer::update_due() noexcept {
  due_ = moment_of(item().until, now(), own_time_, entry_phase_);
}

bool Sequencer::near_goal() const noexcept {
  if (running_ < 0 || finished_) return false;
  return item().until.when == Switch::When::near_goal &&
         (now().goal() - now().sample().position).cwiseAbs().maxCoeff() <= item().until.value;
}

bool Sequencer::hand_over() noexcept {
  ++changes_;
  if (finished_) return false;
  switch_over();
  rescale();
  return true;
}

void Sequencer::switch_over() noexcept {
  if (to_come() > 0) {
    Item& next = items_[static_cast<std::size_t>(running_ + 1 - first_)];
    take_along(next.execution);
    double phase = phase_of(next.entry, next.execution.basis());
    if (std::isnan(phase)) phase = next.execution.least_correction_phase(motion());
    join_to(next.execution, phase, running_ + 1);
    update_due();
    return;
  }
  finished_ = true;
  if (running_ >= 0 && now().kind() == Kind::rhythmic) {
    Execution& rest = *item().rest;
    take_along(rest);
    rest.set_goal(now().goal());
    rest.set_tau(M_PI * now().tau());
    join_to(rest, rest.basis().start_phase(), running_);
    settling_ = true;
  }
}

void Sequencer::join_to(Execution& next, double phase, int primitive) noexcept {
  const Sample& before = running_ < 0 ? start_ : now().state();
  next.reinitialise(before, phase, join_);
  const Sample& after = next.state();
  JoinEvent& event = events_[static_cast<std::size_t>(joins_++ - first_join_)];
  entered_ += own_time_;
  own_time_ = 0.0;
  running_ = primitive;
  settling_ = false;
  entry_phase_ = phase;
  event.time = time();
  event.primitive = primitive;
  event.acceleration_before = before.acceleration;
  event.acceleration_after = after.acceleration;
  event.jerk_before = before.jerk;
  event.jerk_after = after.jerk;
  event.price = next.price();
}

void Sequencer::add_coupling(std::shared_ptr<Coupling> coupling) {
  if (!coupling) throw Error("sequencer", "a coupling is null");
  auto all = couplings_;
  all.push_back(std::move(coupling));
  couple(std::move(all));
  ++changes_;
}

bool Sequencer::remove_coupling(const std::shared_ptr<Coupling>& coupling) {
  auto all = couplings_;
  const auto found = std::find(all.begin(), all.end(), coupling);
  if (found == all.end()) return false;
  all.erase(found);
  couple(std::move(all));
  ++changes_;
  return true;
}

void Sequencer::clear_couplings() {
  couple({});
  ++changes_;
}

void Sequencer::couple(std::vector<std::shared_ptr<Coupling>> all) {
  std::shared_ptr<const Coupling> sum;
  if (all.size() == 1) sum = all.front();
  if (all.size() > 1) sum = std::make_shared<CouplingSum>(all);
  const bool at_start = running_ == 0 && time() == 0.0;
  const Sample start = at_start ? now().state() : start_;
  couplings_ = std::move(all);
  coupling_ = std::move(sum);
  for (Item& item : items_) couple(item);
  if (at_start) {
    now().reinitialise(start, entry_phase_, join_);
    events_.front().acceleration_after = now().state().acceleration;
    events_.front().jerk_after = now().state().jerk;
  }
  rescale();
}

void Sequencer::couple(Item& item) const {
  item.execution.couple(coupling_, motion_time());
  if (item.rest) item.rest->couple(coupling_, motion_time());
}

// To the time at which it begins; it has the memory.
void Sequencer::take_along(Execution& next) const noexcept {
  if (coupling_) next.couple(coupling_, motion_time());
}

bool Sequencer::set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept {
  ++changes_;
  const bool done = running_ >= 0 && now().set_goal(goal);
  rescale();
  return done;
}

bool Sequencer::set_tau(double tau) noexcept {
  ++changes_;
  if (running_ < 0 || !now().set_tau(tau)) return false;
  if (!finished_) update_due();
  rescale();
  return true;
}

// What is wished after the switch would never come, unless nothing follows.
bool Sequencer::in_time(int which, const Wish& wish) const noexcept {
  if (running_ < 0 || settling_) return false;
  const double moment = moment_of(wish.when, now(), own_time_, entry_phase_);
  if (wish.then == Wish::Then::hand_over) return !finished_ && moment >= now().last_moment(which);
  return to_come() == 0 || moment <= due_ + most_slack;
}

bool Sequencer::set_wish(int which, const Wish& wish) noexcept {
  ++changes_;
  if (!in_time(which, wish) || !now().set_wish(which, wish)) return false;
  if (wish.then == Wish::Then::hand_over && !finished_) {
    item().until = wish.when;
    update_due();
  }
  rescale();
  return true;
}

void Sequencer::drop_wishes() noexcept {
  ++changes_;
  if (running_ >= 0) now().drop_wishes();
}

const Price& Sequencer::price_of(int which, const Wish& wish) noexcept {
  return in_time(which, wish) ? now().price_of(which, wish) : nothing_runs_;
}

bool Sequencer::set_rate(double rate, double over) noexcept {
  ++changes_;
  const bool done = scale_.change(rate, over);
  rescale();
  return done;
}

bool Sequencer::set_amplitude(double amplitude) noexcept {
  ++changes_;
  const bool done = running_ >= 0 && now().set_amplitude(amplitude);
  rescale();
  return done;
}

bool Sequencer::reinitialise(const Sample& at) noexcept {
  ++changes_;
  if (!usable(at, dimensions())) return false;
  scale_ = TimeScale();
  if (running_ < 0)
    start_.position = at.position;
  else
    now().resume(at);
  return true;
}

}  // namespace seam
