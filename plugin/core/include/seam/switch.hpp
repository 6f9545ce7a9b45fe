#pragma once

#include <seam/basis.hpp>
#include <seam/export.hpp>

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
/// The same as `after`, in the words of a wish: task.pass({{"x", 0.5}}, at(0.6)).
inline Switch at(double seconds) {
  return after(seconds);
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
