#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// An acceleration that something outside of the primitives adds to the motion: an obstacle, the other arm, a force.
///     τ²ÿ = K(r − y) − τDẏ + f + τ²·C(y, ẏ, t)
/// for discrete and rhythmic primitives alike. t [s] is the motion's own time since the Sequencer was made (see
/// Sequencer::motion_time), and ẏ is by the same time: both stand where the Sequencer's rate is 0.
///
/// Joins, and changes of goal, τ and amplitude, take C into account: ÿ continues while it acts, with all methods but
/// dmp2. It is the coupling's own job to be 0 when it is added or removed; else ÿ steps by what it is then.
///
/// C is taken at the start, the middle and the end of each step, and the state there is found by three sweeps: seven
/// calls of `add` in a step. The result is of fourth order in dt where C has two continuous derivatives and is smooth
/// between. In a step in which its second derivative steps, an error of order dt³ is left in ẏ; where it bends, of order dt²;
/// where C itself steps, of order dt. The sweeps find nothing unless |∂C/∂ẏ|·dt and |∂C/∂y|·dt² are well below 1: of a
/// stiff spring dt has to be a tenth of the time constant or less.
class Coupling {
 public:
  virtual ~Coupling() = default;
  /// Adds C to an acceleration.
  /// @param y    D values [rad or m]
  /// @param yd   D values [per s]
  /// @param t    [s], of the motion's own time; asked for in any order, also 10 µs before the present
  /// @param ydd  D values [per s²], to which C is added; they have to stay finite
  virtual void add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
                   Eigen::VectorXd& ydd) const noexcept = 0;
};

}  // namespace seam
