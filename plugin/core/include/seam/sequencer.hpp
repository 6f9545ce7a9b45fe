#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/compensated_sum.hpp>
#include <seam/coupling.hpp>
#include <seam/execution.hpp>
#include <seam/export.hpp>
#include <seam/join.hpp>
#include <seam/sequence.hpp>
#include <seam/time_scale.hpp>

namespace SEAM_API seam {

/// What happened at a join: the one-sided accelerations and jerks, from the equations and not from samples, in the
/// sequence's own time (see Sequencer::set_rate).
struct JoinEvent {
  double time = 0.0;                    // [s]
  int primitive = 0;                    // index of the one that took over; 0 is the start
  Eigen::VectorXd acceleration_before;  // D
  Eigen::VectorXd acceleration_after;   // D
  Eigen::VectorXd jerk_before;          // D
  Eigen::VectorXd jerk_after;           // D
  Price price;                          // of what is wished of the primitive
};

/// Plays a sequence: steps the running primitive, and joins the next to it at exactly the time of the switch, inside
/// a step if need be (a switch on nearness to the goal falls on a tick). The queue, the goal, tau and the amplitude can be
/// changed while it runs.
///
/// When the last switch has been due a discrete primitive goes on towards its goal; a rhythmic one is followed by a
/// motion that settles at its goal, joined like any other.
/// What a primitive's wishes cost is known when it begins (JoinEvent::price). To know it before the arm moves, play a second Sequencer
/// without an arm (see rollout) and look at its joins.
///
/// Construction, `append` and `replace` allocate; nothing else does, nor throws. `append` and `replace` also let go of
/// the primitives that have been played and of all but the latest joins, so that an app may append for days; indices
/// go on counting.
class Sequencer {
 public:
  /// @param start  state to begin in, usually at rest where the arm is; it is joined to as well
  /// @throws Error  the sequence is empty, start has other dimensions or is not finite, it is not at rest where the
  ///                first primitive is delayed, or a wish cannot be met by this method whatever the state
  Sequencer(const Sequence& sequence, const JoinSettings& join, const Sample& start);

  /// Advances by dt [s] ≥ 0.
  void step(double dt) noexcept;

  /// Hands over to the next primitive now, whatever its switch says; the last one is finished by it. False where the
  /// sequence is finished already.
  bool hand_over() noexcept;
  /// Goal of what runs now (see Execution). False, and no change, where nothing runs yet or the value will not do.
  bool set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept;
  bool set_tau(double tau) noexcept;              // [s] likewise
  bool set_amplitude(double amplitude) noexcept;  // likewise
  /// Slows down (rate < 1), speeds up (> 1) or pauses (0) the whole sequence: its time moves smoothly to another rate over a
  /// time [s] > 0, on the same path, with every method (see TimeScale). For a pause this is the way; a large tau is not, for
  /// with v = τẏ an arm that moves would go on moving. While the rate moves every step is of another
  /// length and needs a propagator of its own, which takes more than twice the time (`make micro`).
  bool set_rate(double rate, double over) noexcept;
  /// Continues what runs now from a state, e.g. a measured one, at its present phase and at rate 1; what still waits for its
  /// beginning waits there, at rest. False where the state will not do.
  bool reinitialise(const Sample& at) noexcept;

  /// Makes or moves a wish of what runs now (see Execution and Wish), e.g. 30 times a second as a camera sees it. One that is to hand over
  /// moves the switch, too.
  /// @param which  its index among the primitive's wishes, those of its sequence first; wishes(): one more
  /// @return  false, and no change, where it cannot be, nothing runs, or its moment is after the switch
  bool set_wish(int which, const Wish& wish) noexcept;
  /// Takes back all wishes of what runs now that are to come; the motion stays what it is.
  void drop_wishes() noexcept;
  /// What a wish of what runs now would cost if it were made now; nothing is changed. Not possible where nothing runs.
  /// @return  valid until the next change or question
  const Price& price_of(int which, const Wish& wish) noexcept;
  /// What the wishes cost with which what runs now was entered, or what runs first is going to be.
  const Price& price() const noexcept { return first_or_now().price(); }
  /// Wishes of what runs now, or runs first, so far.
  int wishes() const noexcept { return first_or_now().wishes(); }
  /// False where one of them is not met (see Execution).
  bool wishes_hold() const noexcept { return first_or_now().wishes_hold(); }

  /// Adds an acceleration to the motion from now on (see Coupling), also to what is appended later; several add up. While
  /// the start is held before the first primitive none acts. ÿ steps by what it is when it is added or removed, which
  /// should be 0; not so before the first step, where the start is joined to again. Adding and removing allocate, the
  /// steps do not.
  /// @param coupling  shared: copies of the sequencer have the same ones, but each its own list
  /// @throws Error  it is null
  void add_coupling(std::shared_ptr<Coupling> coupling);
  /// False where it is not there.
  bool remove_coupling(const std::shared_ptr<Coupling>& coupling);
  /// Removes all.
  void clear_couplings();
  /// In the order in which they were added.
  const std::vector<std::shared_ptr<Coupling>>& couplings() const noexcept { return couplings_; }

  /// Adds a sequence's primitives behind the last one. Its start delay is ignored.
  /// @throws Error  its coordinates or reference orientation differ
  void append(const Sequence& sequence);
  /// Drops what has not begun yet, then appends.
  /// @throws Error  its coordinates or reference orientation differ
  void replace(const Sequence& sequence);
  /// Drops what has not begun yet.
  void clear() noexcept;

  /// The present state in real time. Its jerk is not kept up to date: see state().
  const Sample& sample() const noexcept { return scale_.is_real_time() ? motion() : scaled_; }
  /// The present state in real time with the jerk, also while the rate moves (see TimeScale).
  const Sample& state() noexcept;
  double time() const noexcept { return entered_ + own_time_ + behind_; }  // [s] since construction
  /// Time of the motion since what runs now began [s], from which the times of its switch and its wishes count.
  double own_time() const noexcept { return own_time_; }
  /// [s] since construction in the sequence's own time, which is what couplings are told; it differs from `time` once the
  /// rate has not been 1.
  double motion_time() const noexcept { return entered_ + own_time_; }
  double rate() const noexcept { return scale_.rate(); }  // of the sequence's time to real time
  /// Goal of what runs now, or runs first.
  Eigen::Map<const Eigen::VectorXd> goal() const noexcept { return first_or_now().goal(); }
  int running() const noexcept {
    return running_;
  }  // index of the primitive; -1 while still waiting
  double phase() const noexcept { return running_ < 0 ? 0.0 : now().phase(); }  // x or φ
  bool finished() const noexcept { return finished_; }  // the last switch has been due
  /// Grows with every change that anything but `step` makes: when it is what it was, the motion and its goal are what the
  /// last step left.
  unsigned changes() const noexcept { return changes_; }
  int dimensions() const noexcept { return static_cast<int>(start_.position.size()); }   // D
  const std::vector<std::string>& coordinates() const noexcept { return coordinates_; }  // D names
  /// Joins so far, the start included.
  int joins() const noexcept { return joins_; }
  /// The oldest that is still there: 0 until `append` or `replace` find more than `kept_joins`.
  int first_join() const noexcept { return first_join_; }
  /// @param i  first_join() ≤ i < joins()
  const JoinEvent& join(int i) const noexcept {
    return events_[static_cast<std::size_t>(i - first_join_)];
  }
  static constexpr int kept_joins = 100;  // at least, of those that are past

 private:
  struct Item {
    Execution execution;
    std::optional<Execution> rest;  // settles at the goal of a rhythmic one that nothing follows
    Switch until;
    Entry entry;
  };

  const Item& item() const noexcept { return items_[static_cast<std::size_t>(running_ - first_)]; }
  Item& item() noexcept { return items_[static_cast<std::size_t>(running_ - first_)]; }
  /// In the motion's own time, as everything below.
  const Sample& motion() const noexcept { return running_ < 0 ? start_ : now().sample(); }
  void advance(double dt, double time) noexcept;
  void rescale() noexcept;
  const Execution& now() const noexcept { return settling_ ? *item().rest : item().execution; }
  Execution& now() noexcept { return settling_ ? *item().rest : item().execution; }
  const Execution& first_or_now() const noexcept {
    return running_ < 0 ? items_.front().execution : now();
  }
  /// How many have not begun yet.
  int to_come() const noexcept { return first_ + static_cast<int>(items_.size()) - running_ - 1; }
  void require_joinable(const Sequence& sequence) const;
  void forget_played();
  void push(const Sequence& sequence);
  bool in_time(int which, const Wish& wish) const noexcept;
  double due() const noexcept;
  void update_due() noexcept;
  bool near_goal() const noexcept;
  void switch_over() noexcept;
  void join_to(Execution& next, double phase, int primitive) noexcept;
  void couple(std::vector<std::shared_ptr<Coupling>> all);
  void couple(Item& item) const;
  void take_along(Execution& next) const noexcept;

  JoinSettings join_;
  Sample start_;
  double start_delay_;
  std::vector<std::string> coordinates_;
  std::optional<Eigen::Quaterniond> reference_;  // of the coordinates rx ry rz
  std::deque<Item> items_;                       // from the one with index first_ on
  std::deque<JoinEvent> events_;                 // from first_join_ on, with room for those to come
  int first_ = 0;
  int first_join_ = 0;
  int joins_ = 0;
  unsigned changes_ = 0;
  TimeScale scale_;
  Sample scaled_;             // the motion in real time, where that is another
  CompensatedSum behind_;     // [s] of the motion's time behind real time
  CompensatedSum entered_;    // [s] when what runs now began
  CompensatedSum own_time_;   // [s] since then
  double due_ = 0.0;          // [s] of own time, when its switch is due
  double entry_phase_ = 0.0;  // of what runs now
  int running_ = -1;
  bool finished_ = false;
  Price nothing_runs_;  // of a wish that cannot be
  bool settling_ = false;
  std::vector<std::shared_ptr<Coupling>> couplings_;
  std::shared_ptr<const Coupling> coupling_;  // their sum; null without any
};

}  // namespace seam
