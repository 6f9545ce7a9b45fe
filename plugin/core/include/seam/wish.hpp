#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/switch.hpp>

namespace SEAM_API seam {

/// Values of some coordinates by their names, e.g. {{"x", 0.5}, {"z", 0.2}}.
using Values = std::map<std::string, double>;

/// What is wished of a running primitive's motion at a moment to come. The weights are changed for it when the primitive is
/// entered, by the smallest change that also meets what the join asks for (see Execution), so that the motion goes there
/// without a step in acceleration.
///
/// A moment is a Switch that is due at a time or a phase: after (or `at`), before_end, at_phase, cycles. Times are the
/// motion's own (see Sequencer::set_rate); a time after the beginning stays where it is when tau changes, a phase and a time
/// before the end move with it.
struct Wish {
  /// What happens at the moment.
  enum class Then {
    go_on,      ///< nothing else
    hand_over,  ///< the next primitive takes over
    stay,       ///< the motion has arrived at the goal, and stays there: the forcing ends
  };

  Switch when;                   // the moment
  Eigen::VectorXd position;      // D; NaN where it is free, or empty: [rad or m]
  Eigen::VectorXd velocity;      // D, likewise
  Eigen::VectorXd acceleration;  // D, likewise
  Then then = Then::go_on;       // what happens at the moment
  /// Of arrival, whose position is the goal and whose velocity is 0: with no acceleration either, and for dmp2j without jerk. Else
  /// the acceleration that is left dies out critically damped, and the arm leaves its goal a little once more.
  bool smooth = true;
};

/// Through a position, at a moment.
/// @param position  D; NaN where it is free
Wish pass(Eigen::VectorXd position, Switch when);
/// To a position with a velocity at a moment, when the next primitive takes over.
/// @param position  D; NaN where it is free
/// @param velocity  D; NaN where it is free
Wish hit(Eigen::VectorXd position, Eigen::VectorXd velocity, Switch when);
/// At the goal and at rest at a moment, and from then on.
/// @param smooth  see Wish::smooth
Wish arrive(Switch when = at_end(), bool smooth = true);

/// How many wishes a primitive has at most, those that are over included, unless its sequence gives it more.
inline constexpr int most_wishes = 8;

/// What wishes cost, told before the arm moves.
struct Price {
  /// Whether they can be met at all.
  bool possible = true;
  /// D [rad or m]: how far the motion is at most from what it would be without the wishes (at a change on the way: without the change).
  Eigen::VectorXd deviation;
  /// D [rad/s² or m/s²]: greatest acceleration of the motion from now until its last wish, discrete until tau at least.
  Eigen::VectorXd acceleration;
};

}  // namespace seam
