#include <cmath>

#include <seam/error.hpp>
#include <seam/sequence.hpp>

namespace seam {

namespace {

std::string name(std::size_t step) {
  return "sequence: primitive " + std::to_string(step + 1);
}

}  // namespace

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
  steps_.push_back({std::move(primitive), at_end()});
  return *this;
}

Sequence& Sequence::until(Switch when) {
  if (steps_.empty()) throw Error("sequence", "until() before any primitive");
  Step& step = steps_.back();
  const double due = when.due(step.primitive.tau);
  if (!(std::isfinite(due) && due > 0.0))
    throw Error(name(steps_.size() - 1), "its switch is due " + std::to_string(due) +
                                             " s after its start, must be > 0 (it lasts " +
                                             std::to_string(step.primitive.tau) + " s)");
  step.until = when;
  return *this;
}

const std::vector<std::string>& Sequence::coordinates() const {
  if (steps_.empty()) throw Error("sequence", "empty, must have at least one primitive");
  return steps_.front().primitive.coordinates;
}

double Sequence::duration() const {
  double sum = start_delay_;
  for (const Step& step : steps_) sum += step.until.due(step.primitive.tau);
  return sum;
}

}  // namespace seam
