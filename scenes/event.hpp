#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <seam/sequencer.hpp>

namespace seam {

class YamlEntry;

/// Something that happens to a running sequence at a time.
struct Event {
  enum class What { goal, tau, amplitude, rate, hand_over, pass, hit };

  double at = 0.0;  // [s] since the run began; takes effect at the first tick then or later
  What what = What::goal;
  Eigen::VectorXd goal;      // D; NaN where a coordinate's goal stays
  double value = 0.0;        // tau [s], amplitude or rate
  double over = 0.0;         // [s] in which the rate changes
  Eigen::VectorXd velocity;  // of a wish, likewise, or empty
  double when = 0.0;         // [s] since the run began: a wish's moment, at rate 1
  int which = -1;            // index of the wish that is moved, or made; -1: one more

  /// False where the sequencer refuses it (an amplitude of a discrete primitive, say).
  bool happen(Sequencer& sequencer) const noexcept;
};

/// Times [s] of a camera's pictures: the keys `from`, `to` and `every` of an entry.
/// @throws Error  names file, line and key
std::vector<double> picture_times(const YamlEntry& entry);

/// As they happen; those of one time stay in their order.
void sort_by_time(std::vector<Event>& events);

/// Reads the list `events:` of a scene (see scenes/README.md), sorted by time. One that is seen by a camera becomes an
/// event per picture, with normally distributed noise on each coordinate that it names.
/// @param seed  of the noise
/// @throws Error  names file, line and key
std::vector<Event> read_events(const YamlEntry& entry, const std::vector<std::string>& coordinates,
                               int seed);

}  // namespace seam
