#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/basis.hpp>
#include <seam/compensated_sum.hpp>
#include <seam/conditions.hpp>
#include <seam/coupling.hpp>
#include <seam/export.hpp>
#include <seam/join.hpp>
#include <seam/primitive.hpp>
#include <seam/propagator.hpp>
#include <seam/wish.hpp>

namespace SEAM_API seam {

class Responses;

/// A primitive while it runs: its state, its own copy of the weights, and the integration of its equations.
/// Construction allocates; nothing after it does, and nothing after it throws.
///
/// Starting, joining and every change on the way are one act: *re-initialise at a state and a phase*. v = τẏ
/// always holds; with a = a(p), w the learned weights and the forcing that the state needs,
///     F = τ²ÿ + τDẏ − K(g − y),   Ḟ = τ²y⃛ + τDÿ + Kẏ        (Eq. 19 and its derivative)
/// a method sets
///     dmp2   r = g
///     dmp2a  r = g,  Δw the smallest with aᵀ(w + Δw) = F (Eq. 21, in which the scale of ψ cancels), or one kernel's
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
///
/// Wishes are more conditions on Δw. With Φⱼ(t) the response, from rest, to kernel j alone, y(t) = y_free(t) + ΦᵀΔw, and likewise
/// ẏ, ÿ, y⃛: a value that is wished at a time is a row of one small system, beside the join's own,
///     aᵀΔw = F − f  (and ȧᵀΔw = Ḟ − ḟ: dmp2j),   Φ(t)ᵀΔw = y_wish − y_free(t),  …
/// solved for the smallest Δw. Where the join is not made by the weights (dmp2, dmp3, changes on the way of a rhythmic
/// primitive, a faded phase) its row is there with 0 on the right: wishes then leave the forcing as it is at that moment. So
/// all methods keep continuous what they keep without wishes. A row of which less than a fifth of the length
/// (of accelerations and jerks a twentieth) lies outside of what those before it span asks for too much (a point too near in time, a faded phase, wishes that contradict each other,
/// more of them than kernels): then the call is refused, and changes nothing. That bounds each row and not the motion, of which the Price
/// tells. Wishes need a table of responses, which more than about 140 kernels, very narrow ones and extreme gains do not have: they are refused, too. Every change on the way solves the system anew for the wishes
/// that are still to come.
///
/// A coupling (see couple) takes the motion off what was solved; once it has let go, the system is solved anew.
///
/// A rhythmic primitive can be wished to pass and to hit within the cycle that is entered; Δw is blended out from the last wish on.
class Execution {
 public:
  /// Stands at the primitive's own start (the demonstration's first position and velocity, r = g).
  /// @param wishes  of every time that it is entered
  /// @param leave   D [rad/s² or m/s²], or empty: acceleration with which it is entered, in place of the predecessor's; NaN:
  ///                that one
  /// @throws Error  the primitive or a wish is not valid
  explicit Execution(const Primitive& primitive, const std::vector<Wish>& wishes = {},
                     const Eigen::VectorXd& leave = {});
  /// @throws Error  the first wish that cannot be met, whatever the state, where the primitive is entered at a phase by a
  ///                method
  void require_possible(double phase, const JoinSettings& join);

  /// Enters the primitive: continues from a state at a phase of it, which the caller vouches for: D finite values each (the jerk
  /// counts for dmp2j alone), 0 < x ≤ 1 or φ finite. A wish that cannot be met from there, beside those before it, is dropped (see wishes_hold).
  void reinitialise(const Sample& from, double phase, const JoinSettings& join) noexcept;
  /// Continues the primitive from another state where it is, with the weights as learned; likewise.
  void resume(const Sample& from) noexcept;
  /// Advances by dt [s] ≥ 0. Exact in the linear part, of fourth order in the forcing.
  void step(double dt) noexcept;

  /// Changes on the way; the execution continues from its present state by the method it was last
  /// re-initialised with. False, and nothing is changed, where a value is not finite or out of range, or what is wished could no
  /// longer be met.
  bool set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept;
  bool set_tau(double tau) noexcept;              // [s] > 0
  bool set_amplitude(double amplitude) noexcept;  // of a rhythmic primitive's forcing; 1 as learned
  /// Makes or moves a wish. @param which  its index; wishes(): one more, of most_wishes at most
  bool set_wish(int which, const Wish& wish) noexcept;
  /// Takes back all wishes that are to come; the motion stays what it is.
  void drop_wishes() noexcept;

  /// [s] since the primitive began until the last moment that is still to come, but for one wish; 0 without any.
  double last_moment(int but) const noexcept;
  int wishes() const noexcept { return wishes_; }  // so far, those that are over included
  /// False where a wish is not met: it was dropped when the primitive was entered or resumed, or when a coupling let go; or a
  /// coupling acted at its moment.
  bool wishes_hold() const noexcept { return wishes_hold_; }
  /// What the wishes cost with which the primitive was entered, or resumed; zero without wishes, not possible where one was dropped.
  const Price& price() const noexcept { return price_; }
  /// What a wish would cost if it were made now; nothing is changed.
  /// @return  valid until the next question
  const Price& price_of(int which, const Wish& wish) noexcept;

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

  // Every state from which the motion goes on is gone on from in two steps: what it takes is found, then it is done.
  void begin_from(const Sample& from, double phase) noexcept;
  bool find_from(const Sample& from, double phase, bool at_join) noexcept;
  void make_up_for(Eigen::Index d, Forcing missing, bool by_weights) noexcept;
  void go_on() noexcept;
  const Sample& remember() noexcept;
  bool go_on_or_back(const Sample& now) noexcept;
  void go_back() noexcept;

  // Wishes (wishes.cpp).
  struct Slot {
    Wish wish;
    bool live = false;
    double left =
        0.0;  // [s] until its moment, as of `schedule`; 0 where it is over or not wished any more
    double due = 0.0;  // [s] of elapsed_
  };
  void make_room(int stride);
  void take(const std::vector<Wish>& wishes, const Eigen::VectorXd& leave);
  void require_ahead(const Wish& wish) const;
  void assign(int which, const Wish& wish) noexcept;
  double due_in(const Wish& wish) const noexcept;
  void schedule() noexcept;
  int pending() const noexcept;
  bool may_set(int which, const Wish& wish) const noexcept;
  const char* unusable(const Wish& wish) const noexcept;
  bool refuse(std::size_t i, const char* why) noexcept;
  void hold_off_fading() noexcept;
  double wished(std::size_t i, int order, Eigen::Index d) const noexcept;
  bool asks_as(Eigen::Index d, Eigen::Index other) const noexcept;
  bool find_changes() noexcept;
  bool evaluate_rows() noexcept;
  bool gather(Eigen::Index d) noexcept;
  void find_change(Eigen::Index d) noexcept;
  double right_side(std::size_t i, int order, Eigen::Index d) const noexcept;
  bool asked() const noexcept;
  void estimate(Price& price) noexcept;
  void keep_worst(Price& price) const noexcept;
  void arrive() noexcept;
  void wish_anew() noexcept;
  void after_a_push(double dt) noexcept;

  bool weights_hold() const noexcept;
  void evaluate_regressor() noexcept;
  double faded(double phase) const noexcept;
  Forcing present(Eigen::Index d) const noexcept;
  Forcing needed(const Sample& from, double acceleration, Eigen::Index d) const noexcept;
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
  double fade_from_ = 1.0;     // φ
  CompensatedSum elapsed_;     // [s] since the last re-initialisation
  double arrival_ = HUGE_VAL;  // likewise, when the motion is to stay
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
  // What wishes need.
  std::shared_ptr<const Responses> responses_;
  std::vector<Slot> slots_;  // with values of D numbers
  Slot spare_;               // what a slot was before a change
  int given_ = 0;            // by the sequence
  int wishes_ = 0;
  bool wishes_hold_ = true;
  bool stays_ = false;        // has arrived
  CompensatedSum passed_;     // [s] since the primitive began until the last re-initialisation
  double begin_phase_ = 1.0;  // where it began
  Eigen::VectorXd leave_;     // D, NaN where the acceleration continues
  Eigen::Matrix<double, Eigen::Dynamic, 2>
      begun_;             // M, what kernels have done until now (see Responses)
  Eigen::MatrixXd rows_;  // M × 4 of each wish: how y, ẏ, ÿ, y⃛ in units of τ answer to the weights
  Eigen::MatrixXd
      free_;  // padded D × 4 of each wish: what comes of state and goal alone [SI units]
  Eigen::MatrixXd flight_;   // padded D × 4: y − g, ẏ, e, ė on their way
  Eigen::MatrixXd missing_;  // padded D × 2: what the weights are to make up for at the join
  Eigen::MatrixXd delta_, by_wishes_,
      total_;  // padded D × padded M: Δw, the wishes' part of it, all weights
  Eigen::Array<double, Eigen::Dynamic, 4>
      answered_;  // padded D: y, v, f of all weights, y of the wishes' part
  Eigen::Matrix<double, Eigen::Dynamic, 3> answers_;  // M, at a point of the table of responses
  Conditions conditions_;
  int join_rows_ = 0;       // how many of the conditions are the join's
  Eigen::MatrixXd before_;  // what a change is taken back to, as the scalars
  double tau_before_ = 1.0, amplitude_before_ = 1.0, fade_from_before_ = 1.0;
  bool fading_before_ = false;
  int pending_before_ = 0;
  Price price_, offer_;  // at entry, of what was asked about
  std::size_t refused_ = 0;
  const char* refusal_ = "";
};

}  // namespace seam
