#include <cmath>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/sequencer.hpp>

namespace seam {
namespace {

/// Holds a hand at a place beside another hand, as a tray would that both carry: a stiff damped spring
///     C = k(y_other + offset − y) + d(ẏ_other − ẏ)
/// to where the other one's present state says that it must be. Within a step the other moves on by its own velocity and
/// acceleration, so that nothing hangs on which of the two is stepped first; what is left of that is of order dt³.
/// The other has to outlive it, and runs at rate 1.
class HeldTogether : public Coupling {
 public:
  /// @param offset  [m] from the other hand to this one
  /// @param k       [1/s²]; d [1/s] damps critically what two such springs do to each other
  HeldTogether(const Sequencer& other, const Eigen::VectorXd& offset, double k)
      : other_(other), offset_(offset), k_(k), d_(std::sqrt(2.0 * k)) {}

  void add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
           Eigen::VectorXd& ydd) const noexcept override {
    const Sample& other = other_.sample();
    const double since = t - other_.motion_time();
    ydd += k_ * (other.position + since * other.velocity +
                 0.5 * since * since * other.acceleration + offset_ - y) +
           d_ * (other.velocity + since * other.acceleration - yd);
  }

 private:
  const Sequencer& other_;
  Eigen::VectorXd offset_;
  double k_, d_;
};

Sequence carry(const Eigen::Vector3d& from) {
  const Demonstration one = test::minimum_jerk();
  const auto moved = [&](const Eigen::Vector3d& way) {
    Demonstration demo = one;
    demo.coordinates = {"x", "y", "z"};
    demo.position = one.position * way.transpose();
    demo.position.rowwise() += from.transpose();
    demo.velocity = one.velocity * way.transpose();
    demo.acceleration = one.acceleration * way.transpose();
    return learn(demo);
  };
  Sequence task;
  task.then(moved({0.3, 0.1, 0.2})).until(after(0.7)).then(moved({0.4, -0.2, 0.1}));
  return task;
}

struct Carried {
  double worst = 0.0;    // [m] by which the hands are not at their distance
  double largest = 0.0;  // [m/s²] change of an acceleration from tick to tick, or at a change
};

// Two hands 0.6 m apart with the same way to go; the left one's goal is moved by 0.1 m at 0.4 s, and the next one's at 1.1 s.
Carried carry_a_tray(bool held, const JoinSettings& method, double dt) {
  const Eigen::Vector3d apart(0.0, -0.6, 0.0);
  const Sequence left_task = carry(Eigen::Vector3d::Zero());
  const Sequence right_task = carry(apart);
  Sequencer left(left_task, method, left_task.start_state());
  Sequencer right(right_task, method, right_task.start_state());
  if (held) {
    left.add_coupling(std::make_shared<HeldTogether>(right, -apart, 4000.0));
    right.add_coupling(std::make_shared<HeldTogether>(left, apart, 4000.0));
  }
  Carried carried;
  const int ticks = static_cast<int>(std::lround(2.5 / dt));
  for (int k = 0; k < ticks; ++k) {
    const Eigen::VectorXd before[] = {left.sample().acceleration, right.sample().acceleration};
    if (k == ticks * 4 / 25 || k == ticks * 11 / 25) {
      EXPECT_TRUE(left.set_goal(left.goal() + Eigen::Vector3d(0.0, 0.0, 0.1)));
      EXPECT_LT((left.state().acceleration - before[0]).norm(), 1e-9);
    }
    left.step(dt);
    right.step(dt);
    carried.largest = std::max({carried.largest, (left.sample().acceleration - before[0]).norm(),
                                (right.sample().acceleration - before[1]).norm()});
    carried.worst =
        std::max(carried.worst, (right.sample().position - left.sample().position - apart).norm());
  }
  EXPECT_EQ(left.joins(), 2);
  return carried;
}

TEST(TwoArms, KeepTheirDistanceWhenOneIsSentElsewhere) {
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
    const Carried alone = carry_a_tray(false, method, 1e-3);
    const Carried held = carry_a_tray(true, method, 1e-3);
    EXPECT_GT(alone.worst, 0.09) << to_string(method);
    EXPECT_LT(held.worst, 0.1 * alone.worst) << to_string(method);
  }
}

TEST(TwoArms, AreHeldWithoutAStepInAcceleration) {
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j}) {
    const double coarse = carry_a_tray(true, method, 2e-3).largest;
    const double fine = carry_a_tray(true, method, 5e-4).largest;
    EXPECT_GT(std::log2(coarse / fine) / 2.0, 0.9) << to_string(method);
  }
}

TEST(TwoArms, AllocateNothing) {
  const Sequence task = carry(Eigen::Vector3d::Zero());
  Sequencer left(task, Join::dmp2a, task.start_state());
  Sequencer right(task, Join::dmp2a, task.start_state());
  left.add_coupling(std::make_shared<HeldTogether>(right, Eigen::Vector3d::Zero(), 4000.0));
  right.add_coupling(std::make_shared<HeldTogether>(left, Eigen::Vector3d::Zero(), 4000.0));
  const AllocationGuard guard;
  for (int k = 0; k < 2000; ++k) {
    left.step(1e-3);
    right.step(1e-3);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace seam
