#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// An acceleration that something outside of the primitives adds to the motion: an obstacle, the other arm, a force.
///     τ²ÿ = K(r − y) − τDẏ + f + τ²·C(y, ẏ, t)
/// for discrete and rhythmic primitives alike. t [s] is the motion's own time since the Sequencer was made: it stands where
/// the Sequencer's rate is 0, and ẏ is by the same time (see Sequencer::motion_time).
///
/// Joins, and changes of goal, τ and amplitude, take C into account: ÿ continues while it acts, with all methods but dmp2. It is
/// the coupling's own job to be 0 when it is added or removed; else ÿ steps by what it is then.
///
/// C is taken at the start, the middle and the end of each step, and the state there is found by three sweeps: seven
/// calls of `add` in a step. The result is of fourth order in dt where C is four times differentiable. Where it has a bend, the step with
/// the bend leaves an error of order dt² in ẏ; where its second derivative steps, of order dt³; where C itself steps, of order dt. The sweeps
/// find nothing unless |∂C/∂ẏ|·dt and |∂C/∂y|·dt² are well below 1: of a spring that is coupled stiffly, dt has to be a
/// tenth of its time constant or less.
class Coupling {
 public:
  virtual ~Coupling() = default;
  /// Adds C to an acceleration.
  /// @param y    D values [rad or m]
  /// @param yd   D values [per s]
  /// @param t    [s], of the motion's own time; a step asks for times in any order, some 10 µs before the present among them
  /// @param ydd  D values [per s²], to which C is added; they have to stay finite
  virtual void add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
                   Eigen::VectorXd& ydd) const noexcept = 0;

 protected:
  Coupling() = default;
  Coupling(const Coupling&) = default;
  Coupling& operator=(const Coupling&) = default;
};

}  // namespace seam
