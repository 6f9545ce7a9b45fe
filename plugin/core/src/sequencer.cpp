#include <cmath>
#include <limits>

#include <seam/error.hpp>
#include <seam/sequencer.hpp>

namespace seam {

namespace {

// Two times closer than this share of a step are the same tick.
constexpr double same_tick = 1e-6;

}  // namespace

Sequencer::Sequencer(const Sequence& sequence, Join method, const Sample& start)
    : method_(method), start_(start), start_delay_(sequence.start_delay()) {
  const std::size_t dimensions = sequence.coordinates().size();
  if (static_cast<std::size_t>(start.position.size()) != dimensions)
    throw Error("sequencer", "start has " + std::to_string(start.position.size()) +
                                 " coordinates, the sequence " + std::to_string(dimensions));
  if (!start.position.allFinite() || !start.velocity.allFinite() || !start.acceleration.allFinite())
    throw Error("sequencer", "start is not finite");
  if (start_delay_ > 0.0 && !(start.velocity.isZero(0.0) && start.acceleration.isZero(0.0)))
    throw Error("sequencer", "start moves, must be at rest where the first primitive is delayed");
  for (const Sequence::Step& step : sequence.steps()) {
    executions_.emplace_back(step.primitive);
    due_.push_back(step.until.due(step.primitive.tau));
  }
  JoinEvent event;
  event.acceleration_before = event.acceleration_after = start.acceleration;
  events_.assign(executions_.size(), event);
  if (start_delay_ == 0.0) hand_over();
}

void Sequencer::step(double dt) noexcept {
  const double slack = same_tick * dt;
  for (double left = dt; left > 0.0;) {
    const double until_due = due() - own_time();
    const double h = until_due < left - slack ? std::max(until_due, 0.0) : left;
    advance(h);
    left -= h;
    if (until_due <= h + slack) hand_over();
  }
}

// In the own time of what runs now.
double Sequencer::due() const noexcept {
  if (finished_) return std::numeric_limits<double>::infinity();
  return running_ < 0 ? start_delay_ : due_[index()];
}

void Sequencer::advance(double dt) noexcept {
  if (running_ < 0)
    waited_ += dt;
  else
    executions_[index()].step(dt);
}

void Sequencer::hand_over() noexcept {
  if (running_ + 1 == static_cast<int>(executions_.size())) {
    finished_ = true;
    return;
  }
  const Sample& before = sample();
  Execution& next = executions_[static_cast<std::size_t>(running_ + 1)];
  next.reinitialise(before, next.start_phase(), method_);
  entered_ += due();
  ++running_;
  JoinEvent& event = events_[index()];
  event.time = entered_;
  event.primitive = running_;
  event.acceleration_before = before.acceleration;
  event.acceleration_after = next.sample().acceleration;
}

}  // namespace seam
