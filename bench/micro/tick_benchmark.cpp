// Cost of a controller's tick of the PA-10 beside one bare call of Bullet's inverse dynamics, on the states of a movement.

#include <memory>

#include <BulletInverseDynamics/MultiBodyTree.hpp>
#include <benchmark/benchmark.h>

#include "bench/micro/arms.hpp"
#include "bench/micro/benchmarks.hpp"
#include "bench/micro/pair.hpp"

namespace seam::micro {

namespace {

namespace id = btInverseDynamics;

constexpr int ticks = 100;  // at one state

id::vec3 bullet(const Eigen::Vector3d& v) {
  return id::vec3(btVector3(v.x(), v.y(), v.z()));
}

id::mat33 bullet(const Eigen::Matrix3d& m) {
  return id::mat33(
      btMatrix3x3(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)));
}

/// Bullet's tree of the robot's moving bodies, and nothing around it.
class BareDynamics {
 public:
  explicit BareDynamics(const RobotModel& model)
      : q_(model.dof()), qd_(model.dof()), qdd_(model.dof()), torque_(model.dof()) {
    for (int i = 0; i < model.dof(); ++i) {
      const Joint& joint = model.joints[static_cast<std::size_t>(i)];
      const Inertial& body = model.bodies[static_cast<std::size_t>(i)].inertial;
      const Eigen::Isometry3d& X = joint.X_parent_body;
      tree_.addBody(i, joint.parent, id::REVOLUTE, bullet(Eigen::Vector3d(X.translation())),
                    bullet(Eigen::Matrix3d(X.linear().transpose())), bullet(joint.axis), body.mass,
                    bullet(body.com), bullet(body.about_origin()), 0, nullptr);
    }
    tree_.finalize();
  }

  void move_to(const Controller::Tick& tick) {
    for (int i = 0; i < q_.size(); ++i) {
      q_(i) = tick.q(i);
      qd_(i) = tick.qd(i);
      qdd_(i) = tick.reference.acceleration(i);
    }
  }

  void calculate() {
    tree_.calculateInverseDynamics(q_, qd_, qdd_, &torque_);
    benchmark::DoNotOptimize(&torque_(0));
    benchmark::ClobberMemory();
  }

 private:
  id::MultiBodyTree tree_;
  id::vecx q_, qd_, qdd_, torque_;
};

Pair tick(const Movement& movement, Join join) {
  const auto arm = std::make_shared<Arms>(1, movement, join);
  const auto bare = std::make_shared<BareDynamics>(pa10());
  const auto go_on = [=, states = played(movement, join), k = std::size_t{0}]() mutable {
    k = k + ticks < states.size() ? k + ticks : 0;
    if (k == 0) arm->restart();
    arm->place(states[k].q, states[k].qd);
    bare->move_to(states[k]);
  };
  return {timed([=] {
            for (int i = 0; i < ticks; ++i) arm->tick();
          }),
          timed([=] {
            for (int i = 0; i < ticks; ++i) bare->calculate();
          }),
          ticks, go_on};
}

}  // namespace

void add_tick_benchmarks() {
  for (const Join join : all_joins)
    add_pair("control tick, " + std::string(to_string(join)) + " / bare inverse dynamics", 1.3,
             5000, [join] { return tick(joint_movement(), join); });
  add_pair("control tick in task space, dmp3 / bare inverse dynamics", no_bar, 1000,
           [] { return tick(tool_movement(), Join::dmp3); });
}

}  // namespace seam::micro
