#pragma once

#include <seam/export.hpp>
#include <seam/join.hpp>
#include <seam/recording.hpp>
#include <seam/sequence.hpp>
#include <seam/sequencer.hpp>

namespace SEAM_API seam {

/// At which times a sequence is looked at, and when that ends.
struct RolloutSettings {
  double dt = 1e-3;     // [s] > 0, between rows
  double settle = 1.0;  // [s] ≥ 0, to go on after the last switch has been due
  double duration =
      0.0;  // [s] of it all, whatever has happened by then; 0: until the last switch and `settle`
  double longest = 600.0;  // [s] after which a sequence that has not finished is given up
};

/// Plays a sequence alone, without an arm: what the coordinates do, in rows at k·dt, and the joins. A recording's ref, ref_vel and
/// ref_acc hold the coordinates as its `joints`; those of a tool (x y z, or x y z rx ry rz) its tool_ref, tool_vel and tool_acc.
/// What an arm would add (q, qd, torque) is empty.
/// @param sequencer  is advanced until the end; a row is its state before a step
/// @throws Error  settings out of range, more than 2e6 rows, or the sequence has not finished after `longest`
Recording rollout(Sequencer& sequencer, const RolloutSettings& settings = {});
/// The same from a sequence, beginning in a state.
/// @throws Error  also what Sequencer refuses
Recording rollout(const Sequence& sequence, const JoinSettings& join, const Sample& start,
                  const RolloutSettings& settings = {});
/// The same from rest where the first primitive's demonstration began.
Recording rollout(const Sequence& sequence, const JoinSettings& join,
                  const RolloutSettings& settings = {});

}  // namespace seam
