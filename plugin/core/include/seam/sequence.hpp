#pragma once

#include <vector>

#include <seam/primitive.hpp>

namespace seam {

/// When a primitive hands over to the next (the last one: when the sequence counts as finished).
struct Switch {
  enum class When { after, before_end };

  When when = When::before_end;
  double seconds = 0.0;  // [s] ≥ 0

  /// Time [s] after the start of a primitive with this tau at which the switch is due.
  double due(double tau) const { return when == When::after ? seconds : tau - seconds; }
};

/// A time [s] after the primitive has begun.
inline Switch after(double seconds) {
  return {Switch::When::after, seconds};
}
/// A time [s] before the primitive's end, which is tau after its beginning.
inline Switch before_end(double seconds) {
  return {Switch::When::before_end, seconds};
}
inline Switch at_end() {
  return before_end(0.0);
}

/// Primitives in their order and the switches between them, as a value.
///
///     Sequence task;
///     task.then(reach).until(before_end(0.4)).then(pour);
class Sequence {
 public:
  struct Step {
    Primitive primitive;
    Switch until;
  };

  /// Holds the start position for a time [s] ≥ 0 before the first primitive begins.
  /// @throws Error  negative or not finite
  Sequence& start_after(double seconds);
  /// Appends a primitive; it runs until its end unless `until` says otherwise.
  /// @throws Error  the primitive is not valid, or its coordinates differ from those before it
  Sequence& then(Primitive primitive);
  /// Sets when the primitive appended last hands over.
  /// @throws Error  nothing appended yet, or the switch would be due before the primitive begins
  Sequence& until(Switch when);

  double start_delay() const { return start_delay_; }  // [s]
  const std::vector<Step>& steps() const { return steps_; }
  /// Coordinate names, those of the first primitive.
  /// @throws Error  the sequence is empty
  const std::vector<std::string>& coordinates() const;
  /// Time [s] from the beginning until the last switch is due.
  double duration() const;

 private:
  std::vector<Step> steps_;
  double start_delay_ = 0.0;
};

}  // namespace seam
