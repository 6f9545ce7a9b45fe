#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <seam/execution.hpp>
#include <seam/join.hpp>
#include <seam/sequence.hpp>
#include <seam/time_scale.hpp>

namespace seam {

/// What happened at a join: the one-sided accelerations and jerks, from the equations and not from samples, in the
/// sequence's own time (see Sequencer::set_rate).
struct JoinEvent {
  double time = 0.0;                    // [s]
  int primitive = 0;                    // index of the one that took over; 0 is the start
  Eigen::VectorXd acceleration_before;  // D
  Eigen::VectorXd acceleration_after;   // D
  Eigen::VectorXd jerk_before;          // D
  Eigen::VectorXd jerk_after;           // D
};

/// Plays a sequence: steps the running primitive, and joins the next to it at exactly the time of the switch, inside
/// a step if need be (a switch on nearness to the goal falls on a tick). The queue, the goal, tau and the amplitude can be
/// changed while it runs.
///
/// When the last switch has been due a discrete primitive goes on towards its goal; a rhythmic one is followed by a
/// motion that settles at its goal, joined like any other.
/// `step` and the changes neither allocate nor throw; construction, `append` and `replace` allocate.
class Sequencer {
 public:
  /// @param start  state to begin in, usually at rest where the arm is; it is joined to as well
  /// @throws Error  the sequence is empty, or start has other dimensions or is not finite
  Sequencer(const Sequence& sequence, const JoinSettings& join, const Sample& start);

  /// Advances by dt [s] ≥ 0.
  void step(double dt) noexcept;

  /// Hands over to the next primitive now, whatever its switch says; the last one is finished by it. False where the
  /// sequence is finished already.
  bool hand_over() noexcept;
  /// Goal, tau [s] and amplitude of what runs now (see Execution). False, and no change, where nothing runs yet or the
  /// value will not do.
  bool set_goal(const Eigen::Ref<const Eigen::VectorXd>& goal) noexcept;
  bool set_tau(double tau) noexcept;
  bool set_amplitude(double amplitude) noexcept;
  /// Slows down (rate < 1), speeds up (> 1) or pauses (0) the whole sequence: its time moves smoothly to another rate over a
  /// time [s] > 0, on the same path, with every method (see TimeScale). For a pause this is the way; a large tau is not, for
  /// with v = τẏ an arm that moves would go on moving.
  bool set_rate(double rate, double over) noexcept;
  /// Continues what runs now from a state, e.g. a measured one, at its present phase and at rate 1. False where it will not do.
  bool reinitialise(const Sample& at) noexcept;

  /// Adds a sequence's primitives behind the last one. Its start delay is ignored.
  /// @throws Error  its coordinates or reference orientation differ
  void append(const Sequence& sequence);
  /// Drops what has not begun yet, then appends.
  /// @throws Error  its coordinates or reference orientation differ
  void replace(const Sequence& sequence);
  /// Drops what has not begun yet.
  void clear() noexcept;

  const Sample& sample() const noexcept { return scale_.is_real_time() ? motion() : scaled_; }
  double time() const noexcept { return entered_ + own_time_ + behind_; }  // [s] since construction
  double rate() const noexcept { return scale_.rate(); }
  int running() const noexcept {
    return running_;
  }  // index of the primitive; -1 while still waiting
  double phase() const noexcept { return running_ < 0 ? 0.0 : now().phase(); }
  bool finished() const noexcept { return finished_; }  // the last switch has been due
  int dimensions() const noexcept { return static_cast<int>(start_.position.size()); }
  /// Joins so far, the start included.
  int joins() const noexcept { return static_cast<int>(joins_); }
  const JoinEvent& join(int i) const noexcept { return events_[static_cast<std::size_t>(i)]; }

 private:
  struct Item {
    Execution execution;
    Execution rest;  // what settles at the goal of a rhythmic primitive that nothing follows
    Switch until;
    Entry entry;
  };

  std::size_t index() const noexcept { return static_cast<std::size_t>(running_); }
  /// In the motion's own time, as everything below.
  const Sample& motion() const noexcept { return running_ < 0 ? start_ : now().sample(); }
  void advance(double dt, double time) noexcept;
  void rescale() noexcept;
  const Execution& now() const noexcept {
    return settling_ ? items_[index()].rest : items_[index()].execution;
  }
  Execution& now() noexcept { return settling_ ? items_[index()].rest : items_[index()].execution; }
  bool is_last() const noexcept { return running_ + 1 == static_cast<int>(items_.size()); }
  void require_joinable(const Sequence& sequence) const;
  void push(const Sequence& sequence);
  double due() const noexcept;
  void update_due() noexcept;
  bool near_goal() const noexcept;
  void switch_over() noexcept;
  void join_to(Execution& next, double phase, int primitive) noexcept;

  JoinSettings join_;
  Sample start_;
  double start_delay_;
  std::vector<std::string> coordinates_;
  std::optional<Eigen::Quaterniond> reference_;  // of the coordinates rx ry rz
  std::vector<Item> items_;
  std::vector<JoinEvent> events_;
  std::size_t joins_ = 0;
  TimeScale scale_;
  Sample scaled_;             // the motion in real time, where that is another
  double behind_ = 0.0;       // [s] of the motion's time behind real time
  double entered_ = 0.0;      // [s] when what runs now began
  double own_time_ = 0.0;     // [s] since then
  double due_ = 0.0;          // [s] of own time, when its switch is due
  double entry_phase_ = 0.0;  // of what runs now
  int running_ = -1;
  bool finished_ = false;
  bool settling_ = false;
};

}  // namespace seam
