#include <algorithm>
#include <cmath>
#include <limits>

#include "shown.hpp"
#include <seam/error.hpp>
#include <seam/execution.hpp>
#include <seam/orientation.hpp>
#include <seam/sequence.hpp>

namespace seam {

namespace {

std::string name(std::size_t step) {
  return "sequence: primitive " + std::to_string(step + 1);
}

void require_possible(const std::string& place, const Primitive& primitive, const Switch& until) {
  const bool rhythmic = primitive.kind == Kind::rhythmic;
  if (!std::isfinite(until.value)) throw Error(place, "its switch has a value that is not finite");
  if (rhythmic && until.when == Switch::When::before_end)
    throw Error(place, "is rhythmic and has no end, its switch must be another than before_end");
  if (!rhythmic && until.when == Switch::When::cycles)
    throw Error(place, "is discrete and has no cycles, its switch must be another than cycles");
  if (until.when == Switch::When::near_goal && !(until.value > 0.0))
    throw Error(place,
                "its switch is at a distance of " + std::to_string(until.value) + ", must be > 0");
  if (!rhythmic && until.when == Switch::When::at_phase &&
      !(until.value > 0.0 && until.value < 1.0))
    throw Error(place,
                "its switch is at phase " + std::to_string(until.value) + ", must be in (0, 1)");
}

}  // namespace

double phase_of(const Entry& entry, const Basis& basis) noexcept {
  switch (entry.where) {
    case Entry::Where::beginning:
      return basis.start_phase();
    case Entry::Where::phase:
      return entry.phase;
    case Entry::Where::least_correction:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

namespace {

double due_after_entry(const Primitive& primitive, const Switch& until, const Entry& entry) {
  const Basis basis(primitive);
  return due(until, basis, {primitive.tau, 0.0, phase_of(entry, basis), 0.0});
}

// The wish that hands over, if there is one.
const Wish* hit_of(const Sequence::Step& step) {
  for (const Wish& wish : step.wishes)
    if (wish.then == Wish::Then::hand_over) return &wish;
  return nullptr;
}

// What is wished after the switch would never come.
void require_in_time(const Sequence::Step& step, const std::string& place) {
  const double switched = due_after_entry(step.primitive, step.until, step.entry);
  for (std::size_t i = 0; i < step.wishes.size(); ++i) {
    const double moment = due_after_entry(step.primitive, step.wishes[i].when, step.entry);
    if (moment > switched + 1e-9)
      throw Error(place, "wish " + std::to_string(i + 1) + " is for " + shown(moment) +
                             " s after its beginning, must be before its switch at " +
                             shown(switched) + " s");
  }
}

}  // namespace

Sequence::Step& Sequence::last(const char* caller) {
  if (steps_.empty()) throw Error("sequence", std::string(caller) + "() before any primitive");
  return steps_.back();
}

Sequence& Sequence::start_after(double seconds) {
  if (!(std::isfinite(seconds) && seconds >= 0.0))
    throw Error("sequence", "start delay " + std::to_string(seconds) + " s, must be >= 0");
  start_delay_ = seconds;
  return *this;
}

Sequence& Sequence::then(Primitive primitive) {
  primitive.validate();
  if (!steps_.empty() && primitive.coordinates != coordinates())
    throw Error(name(steps_.size()), "its coordinates differ from those of the first primitive");
  if (!steps_.empty()) {
    const auto& reference = steps_.front().primitive.reference_orientation;
    require_same_reference(name(steps_.size()), reference, primitive.reference_orientation);
    primitive.reference_orientation = reference;
  }
  if (!steps_.empty()) require_in_time(steps_.back(), name(steps_.size() - 1));
  const Switch until = primitive.kind == Kind::rhythmic ? after_cycles(1.0) : at_end();
  steps_.push_back({std::move(primitive), until, {}, {}, {}});
  return *this;
}

Sequence& Sequence::then(Step step) {
  then(std::move(step.primitive));
  try {
    if (steps_.back().primitive.kind == Kind::rhythmic) enter(step.entry);
    if (step.leave.size() > 0 && step.leave.size() != steps_.back().primitive.dimensions())
      throw Error(name(steps_.size() - 1), "leave needs an acceleration per coordinate");
    steps_.back().leave = std::move(step.leave);
    for (Wish& one : step.wishes) wish(std::move(one));
    return hit_of(steps_.back()) ? *this : until(step.until);
  } catch (const Error&) {
    steps_.pop_back();
    throw;
  }
}

Sequence& Sequence::until(Switch when) {
  Step& step = last("until");
  const std::string place = name(steps_.size() - 1);
  require_possible(place, step.primitive, when);
  const Wish* hit = hit_of(step);
  if (hit && (hit->when.when != when.when || hit->when.value != when.value))
    throw Error(place, "hands over at its hit, must have no other switch");
  const double seconds = due_after_entry(step.primitive, when, step.entry);
  if (!(seconds > 0.0))
    throw Error(place, "its switch is due " + std::to_string(seconds) +
                           " s after its start, must be > 0 (its tau is " +
                           std::to_string(step.primitive.tau) + " s)");
  step.until = when;
  return *this;
}

Sequence& Sequence::enter(Entry entry) {
  Step& step = last("enter");
  const std::string place = name(steps_.size() - 1);
  if (step.primitive.kind == Kind::discrete)
    throw Error(place, "is discrete and always entered at its beginning");
  if (!std::isfinite(entry.phase)) throw Error(place, "its entry phase is not finite");
  step.entry = entry;
  return *this;
}

Eigen::VectorXd Sequence::named(const Values& values, const char* caller) {
  const std::vector<std::string>& names = last(caller).primitive.coordinates;
  Eigen::VectorXd all = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(names.size()),
                                                  std::numeric_limits<double>::quiet_NaN());
  for (const auto& [coordinate, value] : values) {
    const auto found = std::find(names.begin(), names.end(), coordinate);
    if (found == names.end())
      throw Error(name(steps_.size() - 1),
                  std::string(caller) + ": \"" + coordinate + "\" is not among its coordinates");
    if (!std::isfinite(value))
      throw Error(name(steps_.size() - 1), std::string(caller) + ": " + coordinate + " is " +
                                               shown(value) + ", must be finite");
    all(found - names.begin()) = value;
  }
  return all;
}

Sequence& Sequence::wish(Wish wish) {
  Step& step = last("wish");
  std::vector<Wish> wishes = step.wishes;
  wishes.push_back(std::move(wish));
  try {
    Execution execution(step.primitive, wishes, step.leave);
    const double phase = phase_of(step.entry, execution.basis());
    if (!std::isnan(phase)) execution.require_possible(phase, Join::dmp2);
  } catch (const Error& error) {
    throw Error(name(steps_.size() - 1), error.what());
  }
  if (wishes.back().then == Wish::Then::hand_over) until(wishes.back().when);
  step.wishes = std::move(wishes);
  return *this;
}

Sequence& Sequence::pass(const Values& position, Switch when) {
  return wish(seam::pass(named(position, "pass"), when));
}

Sequence& Sequence::hit(const Values& position, const Values& velocity, Switch when) {
  return wish(seam::hit(named(position, "hit"), named(velocity, "hit"), when));
}

Sequence& Sequence::arrive(Switch when, bool smooth) {
  return wish(seam::arrive(when, smooth));
}

Sequence& Sequence::leave(const Values& acceleration) {
  last("leave").leave = named(acceleration, "leave");
  return *this;
}

const std::vector<std::string>& Sequence::coordinates() const {
  if (steps_.empty()) throw Error("sequence", "empty, must have at least one primitive");
  return steps_.front().primitive.coordinates;
}

Sample Sequence::start_state() const {
  coordinates();  // refuses an empty one
  return Sample::at_rest(steps_.front().primitive.start_position);
}

double Sequence::duration() const {
  double sum = start_delay_;
  for (const Step& step : steps_) sum += due_after_entry(step.primitive, step.until, step.entry);
  return sum;
}

}  // namespace seam
