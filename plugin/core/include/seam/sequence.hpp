#pragma once

#include <string>
#include <vector>

#include <seam/basis.hpp>
#include <seam/export.hpp>
#include <seam/join.hpp>
#include <seam/primitive.hpp>
#include <seam/switch.hpp>
#include <seam/wish.hpp>

namespace SEAM_API seam {

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
///     task.then(hit).pass({{"x", 0.5}}, at(0.6)).arrive();
class Sequence {
 public:
  /// One primitive's part.
  struct Step {
    Primitive primitive;       // a copy
    Switch until;              // when it hands over
    Entry entry;               // at which phase it is entered
    std::vector<Wish> wishes;  // of its motion
    Eigen::VectorXd
        leave;  // D, or empty: acceleration with which it begins, NaN where the predecessor's continues
  };

  /// Holds the start position for a time [s] ≥ 0 before the first primitive begins.
  /// @throws Error  negative or not finite
  Sequence& start_after(double seconds);
  /// Appends a primitive; unless `until` says otherwise a discrete one runs until its end, a rhythmic one for
  /// one cycle.
  /// @throws Error  the primitive is not valid, or its coordinates or reference orientation differ from those before it
  ///                (one that is not known differs from one that is; q and −q do not, and the first one's sign is kept)
  Sequence& then(Primitive primitive);
  /// Appends a primitive with all that is said of it.
  /// @throws Error  whatever the calls below refuse
  Sequence& then(Step step);
  /// Sets when the primitive appended last hands over.
  /// @throws Error  nothing appended yet, or the switch can never be due, or not after the beginning
  Sequence& until(Switch when);
  /// Sets at which phase the rhythmic primitive appended last is entered.
  /// @throws Error  nothing appended yet, the primitive is discrete, or the phase is not finite
  Sequence& enter(Entry entry);

  /// Wishes that the primitive appended last passes through a position of some coordinates at a moment (see Wish); several
  /// are possible.
  /// @throws Error  nothing appended yet, a name is not among its coordinates, or it cannot be, whatever the state (see Execution)
  Sequence& pass(const Values& position, Switch when);
  /// Wishes that it comes to a position with a velocity at a moment, and hands over to the next right there.
  /// @throws Error  likewise
  Sequence& hit(const Values& position, const Values& velocity, Switch when);
  /// Wishes that it is at its goal and at rest at a moment, and stays there.
  /// @param smooth  without acceleration, too (see Wish::smooth)
  /// @throws Error  likewise, or it is rhythmic
  Sequence& arrive(Switch when = at_end(), bool smooth = true);
  /// Wishes that it begins with an acceleration of some coordinates [rad/s² or m/s²], in place of the predecessor's.
  /// @throws Error  nothing appended yet, a name is not among its coordinates, or a value is not finite
  Sequence& leave(const Values& acceleration);
  /// Adds a wish of the primitive appended last. One that is to hand over sets its switch, too, and there is one at most.
  /// @throws Error  likewise
  Sequence& wish(Wish wish);

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
  Eigen::VectorXd named(const Values& values, const char* caller);

  std::vector<Step> steps_;
  double start_delay_ = 0.0;
};

/// The phase that an entry means; NaN for least_correction, which depends on the motion.
double phase_of(const Entry& entry, const Basis& basis) noexcept;

}  // namespace seam
