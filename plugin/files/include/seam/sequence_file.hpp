#pragma once

#include <optional>
#include <string>
#include <vector>

#include <seam/export.hpp>
#include <seam/join.hpp>
#include <seam/obstacles.hpp>
#include <seam/sequence.hpp>

namespace SEAM_API seam {

/// A sequence and what a file says beside it.
struct SequenceFile {
  Sequence sequence;                        // ready to be played
  std::vector<std::string> primitives;      // names, one per step
  std::optional<Sample> start;              // the state to start from, where it is given
  std::vector<ObstacleSettings> couplings;  // what the motion keeps away from: see add_obstacles

  /// The state to start from: `start`, or at rest where the first primitive's demonstration began.
  Sample start_state() const;
};

/// Reads a sequence from a YAML file of the format `seam-sequence 1` or `2`, which adds the keys
/// leave, pass, hit and arrive. Primitives are named once and
/// played as often as they are wanted; paths are relative to the file, and lead, links followed, to its own
/// folder or below, or to folders that are allowed. Keys that may be left out are marked so.
///
///     format: seam-sequence 2
///     start:                            # optional, and so is each part and coordinate
///       position: {x: 0.1}              # else where the first primitive began
///       velocity: {x: 0}                # else 0; likewise acceleration, jerk
///     start_after: 0.25                 # optional [s] at rest before the first primitive
///     reference: [0, 0, 0, 1]           # optional, see below
///     primitives:
///       reach: {file: reach.yaml}       # a primitive file
///       wipe: {demonstration: wipe.csv, kind: rhythmic, period: 1.5}  # learned, see below
///       away: {kind: discrete, …}       # a primitive file's own keys
///     steps:
///       - {play: reach, until: {before_end: 0.4}}   # or after [s], at_phase, cycles,
///                                                   # near_goal [rad or m], on_call
///       - {play: wipe, enter: least_correction, until: on_call}  # or beginning, {phase: 1.2}
///       - {play: away}                  # without until: to its end, or for one cycle
///       - {play: reach, leave: {x: 2}, pass: [{position: {x: 0.2}, at: 0.4}], arrive: yes}   # wishes, see below
///     couplings:                        # optional, see Obstacle: what a tool keeps away from
///       - steer: {at: [0.4, 0, 0.3], strength: 1000, sharpness: 3.2, reach: 0.4}
///       - ball: {at: [0.3, 0.1, 0.2], radius: 0.05, strength: 200, reach: 0.1}
///         appears: {from: 0.5, over: 0.3}           # [s]
///         vanishes: {from: 2, over: 0.3}
///       - box: {at: [0.5, 0, 0.1], size: [0.2, 0.1, 0.3], orientation: [0, 0, 0, 1], strength: 200, reach: 0.1}
///         moves: {to: [0.5, 0.3, 0.1], from: 1, over: 1.5}
///
/// Of an obstacle only at, radius and size must be there, and `from`; of a move all three. Times are the motion's own, from its
/// beginning, start_after included.
///
/// Wishes (see Wish and Sequence::wish), in the order in which they count: `pass`, a list; `hit`, one, which sets `until` as well;
/// `arrive`. Each is a map of what is wished (position, velocity, acceleration: values of some coordinates; orientation:
/// unit quaternion x y z w, in place of rx, ry and rz) and of one moment (at [s] after its beginning, before_end [s], at_phase,
/// cycles). `arrive` is yes (at its end) or a map of a moment and, optional, `smooth: no`. `leave` gives accelerations with which it begins
/// [rad/s² or m/s²].
///
/// A demonstration is learned with LearnSettings and DerivativeSettings, all optional: kind, period
/// [s], kernels, width, precision [m or rad], method (least_squares, recursive, locally_weighted),
/// alpha, gains: {K, D, H} (D and H optional: critical), cutoff [Hz]; and speed, a factor by which the movement is
/// played faster than it was shown. Of kernels there may be 1000, and samples·kernels² up to 10¹⁰ (with a precision,
/// samples·4/3·kernels³): some seconds of learning.
///
/// `reference`, a unit quaternion x y z w, is the reference orientation of all primitives with the
/// coordinates rx ry rz: the columns qx qy qz qw of demonstrations are turned from it, primitives
/// that carry none are taken as about it, those that carry another are refused. Without the key
/// demonstrations are turned from that of the first primitive that carries one, else from the first
/// sample of the first demonstration with an orientation.
/// @param allowed  folders of which files may be named beside its own, e.g. {"/data/demos"}; {"/"}: any
/// @throws Error  names file, line and key: unreadable, not YAML, more than 4 MiB, 200 000 values or 32 levels, a newer
///                format, a missing, extra or repeated key, a path that leads out of the folders, a value that is not a finite
///                number or out of range, a name that
///                is not among the primitives, and whatever Sequence, learn or a file that is named
///                refuses
SequenceFile read_sequence(const std::string& path, std::vector<std::string> allowed = {});

/// Writes a sequence with all its primitives and 17 significant digits: it comes back bit for bit, wishes in the order above. Of format 1
/// where nothing is wished, so that an older seam can read it.
/// The file appears whole or not at all.
/// @throws Error  it has no steps, a name is missing, or stands for two different primitives; the
///                start has other dimensions or is not finite; the file cannot be written
void write_sequence(const std::string& path, const SequenceFile& file);

}  // namespace seam
