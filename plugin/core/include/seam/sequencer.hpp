#pragma once

#include <vector>

#include <Eigen/Core>

#include <seam/execution.hpp>
#include <seam/join.hpp>
#include <seam/sequence.hpp>

namespace seam {

/// What happened at a join: the one-sided accelerations, taken from the equations and not from
/// samples.
struct JoinEvent {
  double time = 0.0;                    // [s]
  int primitive = 0;                    // index of the one that took over; 0 is the start
  Eigen::VectorXd acceleration_before;  // D
  Eigen::VectorXd acceleration_after;   // D
};

/// Plays a sequence: steps the running primitive, and joins the next to it at exactly the time of
/// the switch, inside a step if need be. After the last switch the last primitive goes on towards
/// its goal. Construction allocates; `step` does not, and does not throw.
class Sequencer {
 public:
  /// @param start  state to begin in, usually at rest where the arm is; it is joined to as well
  /// @throws Error  the sequence is empty, or start has other dimensions or is not finite
  Sequencer(const Sequence& sequence, Join method, const Sample& start);

  /// Advances by dt [s] ≥ 0.
  void step(double dt) noexcept;

  const Sample& sample() const noexcept {
    return running_ < 0 ? start_ : executions_[index()].sample();
  }
  double time() const noexcept { return entered_ + own_time(); }  // [s] since construction
  int running() const noexcept {
    return running_;
  }  // index of the primitive; -1 while still waiting
  bool finished() const noexcept { return finished_; }  // the last switch has been due
  int dimensions() const noexcept { return static_cast<int>(start_.position.size()); }
  /// Joins so far, the start included.
  int joins() const noexcept { return running_ + 1; }
  const JoinEvent& join(int i) const noexcept { return events_[static_cast<std::size_t>(i)]; }

 private:
  std::size_t index() const noexcept { return static_cast<std::size_t>(running_); }
  double own_time() const noexcept {
    return running_ < 0 ? waited_ : executions_[index()].elapsed();
  }
  double due() const noexcept;
  void advance(double dt) noexcept;
  void hand_over() noexcept;

  Join method_;
  Sample start_;
  double start_delay_;
  std::vector<Execution> executions_;
  std::vector<double> due_;  // [s] of each primitive's own time
  std::vector<JoinEvent> events_;
  double entered_ = 0.0;  // [s] when what runs now began
  double waited_ = 0.0;   // [s] before the first primitive
  int running_ = -1;
  bool finished_ = false;
};

}  // namespace seam
