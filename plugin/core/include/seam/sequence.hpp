#pragma once

#include <string>
#include <vector>

#include <seam/basis.hpp>
#include <seam/export.hpp>
#include <seam/join.hpp>
#include <seam/primitive.hpp>

namespace SEAM_API seam {

/// When a primitive hands over to the next (the last one: when the sequence counts as finished).
struct Switch {
  /// What is waited for.
  enum class When {
    after,       ///< a time [s] after the primitive has begun
    before_end,  ///< a time [s] before a discrete primitive's end, which is tau after its beginning
    at_phase,    ///< when x has fallen to, or φ has risen to, a value (φ: its next occurrence)
    near_goal,   ///< at the first tick with all coordinates within a distance of the goal
    cycles,      ///< after a number of a rhythmic primitive's cycles
    on_call,     ///< when Sequencer::hand_over is called, and not before
  };

  When when = When::before_end;  // what is waited for
  double value = 0.0;            // [s], phase, [rad or m], or number, as `when` says
};

/// A time [s] after the primitive has begun.
inline Switch after(double seconds) {
  return {Switch::When::after, seconds};
}
/// A time [s] before a discrete primitive's end.
inline Switch before_end(double seconds) {
  return {Switch::When::before_end, seconds};
}
/// At a discrete primitive's end.
inline Switch at_end() {
  return before_end(0.0);
}
/// When x has fallen to a value in (0, 1), or φ [rad] comes to one.
inline Switch at_phase(double phase) {
  return {Switch::When::at_phase, phase};
}
/// At the first tick with all coordinates within a distance [rad or m] of the goal.
inline Switch near_goal(double distance) {
  return {Switch::When::near_goal, distance};
}
/// After a number of a rhythmic primitive's cycles, whole or not.
inline Switch after_cycles(double cycles) {
  return {Switch::When::cycles, cycles};
}
/// When Sequencer::hand_over is called.
inline Switch on_call() {
  return {Switch::When::on_call, 0.0};
}

/// At which phase a primitive is entered. A discrete one always at its beginning.
struct Entry {
  /// At what place of the cycle.
  enum class Where {
    beginning,         ///< x = 1, φ = 0
    phase,             ///< φ = phase
    least_correction,  ///< the φ at which the state that is joined to needs the least correction
  };

  Where where = Where::beginning;  // at what place of the cycle
  double phase = 0.0;              // [rad]
};

/// At a phase φ [rad].
inline Entry from_phase(double phase) {
  return {Entry::Where::phase, phase};
}
/// At the phase where the state that is joined to needs the least correction.
inline Entry least_correction() {
  return {Entry::Where::least_correction, 0.0};
}

/// Primitives in their order and the switches between them, as a value.
///
///     Sequence task;
///     task.then(reach).until(before_end(0.4)).then(wipe).enter(least_correction()).until(after_cycles(3)).then(away);
class Sequence {
 public:
  /// One primitive's part.
  struct Step {
    Primitive primitive;  // a copy
    Switch until;         // when it hands over
    Entry entry;          // at which phase it is entered
  };

  /// Holds the start position for a time [s] ≥ 0 before the first primitive begins.
  /// @throws Error  negative or not finite
  Sequence& start_after(double seconds);
  /// Appends a primitive; unless `until` says otherwise a discrete one runs until its end, a rhythmic one for
  /// one cycle.
  /// @throws Error  the primitive is not valid, or its coordinates or reference orientation differ from those before it
  ///                (one that is not known differs from one that is; q and −q do not, and the first one's sign is kept)
  Sequence& then(Primitive primitive);
  /// Sets when the primitive appended last hands over.
  /// @throws Error  nothing appended yet, or the switch can never be due, or not after the beginning
  Sequence& until(Switch when);
  /// Sets at which phase the rhythmic primitive appended last is entered.
  /// @throws Error  nothing appended yet, the primitive is discrete, or the phase is not finite
  Sequence& enter(Entry entry);

  double start_delay() const { return start_delay_; }        // [s]
  const std::vector<Step>& steps() const { return steps_; }  // in their order
  /// Coordinate names, those of the first primitive.
  /// @throws Error  the sequence is empty
  const std::vector<std::string>& coordinates() const;
  /// At rest where the first primitive's demonstration began: where a sequence begins unless told otherwise.
  /// @throws Error  the sequence is empty
  Sample start_state() const;
  /// Time [s] until the last switch is due; infinite where that depends on the motion.
  double duration() const;

 private:
  Step& last(const char* caller);

  std::vector<Step> steps_;
  double start_delay_ = 0.0;
};

/// The phase that an entry means; NaN for least_correction, which depends on the motion.
double phase_of(const Entry& entry, const Basis& basis) noexcept;

/// How far a primitive has come.
struct Reached {
  double tau = 1.0;     // [s] what it is now
  double time = 0.0;    // [s] since it began
  double phase = 0.0;   // x or φ
  double turned = 0.0;  // [rad] of φ since it began
};

/// Time [s] from a primitive's beginning until its switch is due, if it goes on from where it is with its present tau;
/// infinite where that depends on the motion.
double due(const Switch& until, const Basis& basis, const Reached& now) noexcept;

}  // namespace seam
