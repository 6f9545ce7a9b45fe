#pragma once

#include <limits>
#include <memory>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/basis.hpp>
#include <seam/compensated_sum.hpp>
#include <seam/coupling.hpp>
#include <seam/export.hpp>
#include <seam/join.hpp>
#include <seam/primitive.hpp>
#include <seam/propagator.hpp>

namespace SEAM_API seam {

/// A primitive while it runs: its state, its own copy of the weights, and the integration of its equations.
/// Construction allocates; nothing after it does, and nothing after it throws.
///
/// Starting, joining and every change on the way are one act: *re-initialise at a state and a phase*. v = τẏ
/// always holds; with a = a(p), w the learned weights and the forcing that the state needs,
///     F = τ²ÿ + τDẏ − K(g − y),   Ḟ = τ²y⃛ + τDÿ + Kẏ        (Eq. 19 and its derivative)
/// a method sets
///     dmp2   r = g
///     dmp2a  r = g,  Δw = a·(F − aᵀw)/|a|² (Eq. 21, in which the scale of ψ cancels), or one kernel's change
///     dmp3   r = y + (τ²ÿ + τDẏ − aᵀw)/K   (Eq. 6)
///     dmp2j  r = g,  Δw the smallest with aᵀ(w + Δw) = F and ȧᵀ(w + Δw) = Ḟ
/// A discrete primitive needs no undo of Δw: x fades. A rhythmic one blends it out over half a cycle by
/// 1 − (10s³ − 15s⁴ + 6s⁵).
///
/// A change on the way (goal, τ, amplitude) keeps the Δw that is there and makes up for what the change alone makes
/// missing, so that a goal may be streamed; discrete by a further Δw, rhythmic by a forcing that is added.
///
/// Weights have lost their hold where a discrete phase has faded to x < 0.05, where |a| vanishes, for dmp2j where
/// the part of ȧ across a is shorter than |a|·|ẋ/x| (rhythmic: |a|·|φ̇|), and where the first kernel, changed
/// alone, is weaker than a tenth of the strongest. dmp2a and dmp2j then add what is missing to the forcing, and it
/// dies out critically damped with the time constant τ/H, ë = −2(H/τ)ė − (H/τ)²e; dmp2a with ė₀ = 0. The filtered goal
/// of dmp3 is the same with ė₀ = −(H/τ)e₀ and r = g + e/K.
class Execution {
 public:
  /// Stands at the primitive's own start (the demonstration's first position and velocity, r = g).
  /// @throws Error  the primitive is not valid
  explicit Execution(const Primitive& primitive);

  /// Continues from a state at a phase of the primitive, which the caller vouches for: D finite values each (the jerk
  /// counts for dmp2j alone), 0 < x ≤ 1 or φ finite.
  void reinitialise(const Sample& from, double phase, const JoinSettings& join) noexcept;
  /// Advances by dt [s] ≥ 0. Exact in the linear part, of fourth order in the forcing.
  void step(double dt) noexcept;

  /// Changes on the way; the execution continues from its present state by the method it was last
  /// re-initialised with. False, and nothing is changed, where a value is not finite or out of range.
  bool set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept;
  bool set_tau(double tau) noexcept;              // [s] > 0
  bool set_amplitude(double amplitude) noexcept;  // of a rhythmic primitive's forcing; 1 as learned

  /// Adds an acceleration C(y, ẏ, t) to the equation of motion from now on, in place of one that acts; null: none. It
  /// allocates, what follows does not. F and Ḟ are then less by τ²C and τ²Ċ, so that joins and changes continue ÿ, and
  /// the jerk, while C acts; ÿ steps by what C is now. Ċ is a central difference along the motion over ±10 µs: of what
  /// changes within 0.1 s it is exact to 1e-8 and better; of a C that bends just here it is the mean of both sides.
  /// @param coupling  shared; it must not be changed within a step
  /// @param time      [s] of the motion, which C is told; it goes on with the steps
  void couple(std::shared_ptr<const Coupling> coupling, double time);

  /// The present state without the jerk.
  const Sample& sample() const noexcept { return sample_; }
  /// The present state with the jerk, y⃛ = (K(ṙ − ẏ) − τDÿ + ḟ)/τ² + Ċ (see couple).
  const Sample& state() noexcept;

  /// Square of the step in acceleration, over all coordinates, that dmp2 would leave if the execution were
  /// re-initialised at a state and a phase: what the other methods have to make up for.
  double correction(const Sample& from, double phase) noexcept;
  /// The phase of a rhythmic primitive at which the least correction is needed to continue from a state.
  double least_correction_phase(const Sample& at) noexcept;

  Kind kind() const noexcept { return basis_.kind(); }      // of the primitive
  const Basis& basis() const noexcept { return basis_; }    // of the primitive
  double phase() const noexcept { return phase_; }          // x or φ
  double tau() const noexcept { return tau_; }              // [s] what it is now
  double amplitude() const noexcept { return amplitude_; }  // what it is now
  /// What it is now; D values.
  Eigen::Map<const Eigen::VectorXd> goal() const noexcept { return {hot_.data(), dimensions()}; }
  int dimensions() const noexcept { return static_cast<int>(sample_.position.size()); }  // D

 private:
  struct Forcing {
    double value, rate;
  };

  void continue_from(const Sample& from, double phase, bool at_join) noexcept;
  void change_weights(Eigen::Index d, Forcing missing) noexcept;
  bool weights_hold() const noexcept;
  void evaluate_regressor() noexcept;
  double faded(double phase) const noexcept;
  Forcing present(Eigen::Index d) const noexcept;
  Forcing needed(const Sample& from, Eigen::Index d) const noexcept;
  void advance(double dt) noexcept;
  void set_step(double dt) noexcept;
  void add_fading(double middle) noexcept;
  void refresh_sample() noexcept;
  void evaluate_coupling(double time, Eigen::VectorXd& value) noexcept;
  void measure_coupling(const Sample& at) noexcept;
  void measure_coupling_rate(const Sample& at) noexcept;
  void set_coupled_step(double dt) noexcept;
  void look_ahead(const Propagator& by) noexcept;
  void predict_coupling(double dt) noexcept;
  void finish_coupling(double dt) noexcept;
  double valley(const Sample& at, double low, double high) noexcept;

  Gains gains_;
  double tau_;
  double amplitude_ = 1.0;
  Basis basis_;
  JoinSettings join_;
  // What a step works on lies together: a column for each of these, then one for each kernel of the weights that act (w,
  // with Δw of a discrete primitive). Coordinates and kernels are filled up with zeros to a multiple of four.
  enum Column {
    target,      // g
    offset,      // y − g
    velocity,    // ẏ
    added,       // e: forcing that is added and dies out; K(r − g) of dmp3
    added_rate,  // ė
    f_start,
    f_middle,
    f_end,
    columns
  };
  // And what most steps have no use for, likewise: these, the learned weights, and Δw of a rhythmic primitive.
  enum RareColumn {
    faded_middle,  // what Δw would add in full
    faded_end,
    rare_columns
  };

  Eigen::Index kernels() const noexcept { return hot_.cols() - columns; }
  auto at(Column column) noexcept { return hot_.col(column); }
  auto at(Column column) const noexcept { return hot_.col(column); }
  auto at(RareColumn column) noexcept { return cold_.col(column); }
  auto weights() noexcept { return hot_.rightCols(kernels()); }
  auto weights() const noexcept { return hot_.rightCols(kernels()); }
  auto learned() noexcept { return cold_.middleCols(rare_columns, kernels()); }
  auto change() noexcept { return cold_.rightCols(kernels()); }
  auto change() const noexcept { return cold_.rightCols(kernels()); }

  Eigen::MatrixXd hot_, cold_;
  Eigen::RowVectorXd row_, slope_;  // M, a(p) and ȧ
  bool fading_ = false;             // Δw of a rhythmic primitive is not zero
  Propagator propagator_;
  double dt_ = std::numeric_limits<double>::quiet_NaN();
  double half_step_ = 0.0;  // what half of dt does to the phase: a factor of x, an addend to φ
  double entry_phase_ = 1.0;
  double phase_ = 1.0;
  double joined_phase_ = 1.0;
  CompensatedSum elapsed_;  // [s] since the last re-initialisation
  // What acts beside the forcing, and what it is worked out with; the columns f_start, f_middle and f_end then hold f + τ²C.
  struct Coupled {
    std::shared_ptr<const Coupling> coupling;
    CompensatedSum time;                 // [s] of the motion
    Propagator half;                     // to the middle of a step, for the forcing of the whole
    Eigen::VectorXd position, velocity;  // D, where C is asked for
    Eigen::VectorXd value, rate;         // D, C and Ċ now
    Eigen::VectorXd middle, end;         // D, C in a step
    Eigen::MatrixX2d uncoupled;          // D × 2, the forcing alone there
  };
  Coupled coupled_;
  Sample sample_;
};

}  // namespace seam
