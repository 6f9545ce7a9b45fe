// Cost of a controller's tick of the PA-10 beside one bare call of Bullet's inverse dynamics, on the states of a movement.

#include <functional>
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
constexpr Join join = Join::dmp3;

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

/// Something that is done at the states of a movement.
struct Work {
  std::function<void()> restart;
  std::function<void(const Controller::Tick&)> move_to;
  std::function<void()> once;
};

Pair beside_bare(const Movement& movement, const Work& work) {
  const auto bare = std::make_shared<BareDynamics>(pa10());
  const auto go_on = [=, states = played(movement, join), k = std::size_t{0}]() mutable {
    k = k + ticks < states.size() ? k + ticks : 0;
    if (k == 0) work.restart();
    work.move_to(states[k]);
    bare->move_to(states[k]);
  };
  return {timed([=] {
            for (int i = 0; i < ticks; ++i) work.once();
          }),
          timed([=] {
            for (int i = 0; i < ticks; ++i) bare->calculate();
          }),
          ticks, go_on};
}

Work controller(const Movement& movement, Join method) {
  const auto arm = std::make_shared<Arms>(1, movement, method);
  return {[=] { arm->restart(); }, [=](const Controller::Tick& at) { arm->place(at.q, at.qd); },
          [=] { arm->tick(); }};
}

// What a controller's tick consists of, from within.

Work arm_controller(const Movement& movement, const RobotModel& model = pa10(),
                    const ControlSettings& law = {}) {
  struct Arm {
    std::unique_ptr<ArmController> controller;
    Eigen::VectorXd q, qd;
  };
  const auto arm = std::make_shared<Arm>();
  ArmControllerSettings settings = settings_for(movement);
  settings.law = law;
  const auto restart = [=] {
    arm->q = movement.start;
    arm->qd.setZero(arm->q.size());
    arm->controller =
        std::make_unique<ArmController>(model, movement.sequence, join, settings, arm->q, arm->qd);
  };
  restart();
  return {restart,
          [=](const Controller::Tick& at) {
            arm->q = at.q;
            arm->qd = at.qd;
          },
          [=] { benchmark::DoNotOptimize(arm->controller->tick(dt, arm->q, arm->qd).data()); }};
}

Work law() {
  struct Law {
    ComputedTorque law{pa10(), {}, pa10().neutral()};
    Controller::Tick at;
    Eigen::VectorXd next, torque;
  };
  const auto law = std::make_shared<Law>();
  return {[] {},
          [=](const Controller::Tick& at) {
            law->at = at;
            law->next = at.reference.position + dt * at.reference.velocity;
            law->torque = at.torque;
            law->law.start(at.qd);
          },
          [=] {
            law->law.torque(dt, law->at.q, law->at.qd, law->at.reference, law->next, law->torque);
            benchmark::DoNotOptimize(law->torque.data());
          }};
}

Work dynamics() {
  struct Dynamics {
    InverseDynamics dynamics{pa10()};
    Controller::Tick at;
  };
  const auto dynamics = std::make_shared<Dynamics>();
  return {[] {}, [=](const Controller::Tick& at) { dynamics->at = at; },
          [=] {
            Controller::Tick& at = dynamics->at;
            dynamics->dynamics.torque(at.q, at.qd, at.reference.acceleration, at.torque);
            benchmark::DoNotOptimize(at.torque.data());
          }};
}

void add(const std::string& what, double bar, int pairs, const Movement& movement,
         const std::function<Work()>& work) {
  add_pair(what + " / bare inverse dynamics", bar, pairs,
           [=] { return beside_bare(movement, work()); });
}

}  // namespace

void add_tick_benchmarks() {
  constexpr int pairs = 5000;
  const Movement joints = joint_movement();
  const Movement tool = tool_movement();
  for (const Join method : all_joins)
    add("control tick, " + std::string(to_string(method)), 1.3, pairs, joints,
        [=] { return controller(joints, method); });
  add("of it, the arm's controller without Bullet's multibody", no_bar, pairs, joints,
      [=] { return arm_controller(joints); });
  add("of that, the control law", no_bar, pairs, joints, law);
  add("of that, the inverse dynamics by seam's class", no_bar, pairs, joints, dynamics);
  ControlSettings observing;
  observing.observer = 60.0;
  add("control tick of an arm with rotors and friction, Bullet's multibody left out", no_bar, pairs,
      joints, [=] { return arm_controller(joints, pa10_with_drives()); });
  add("the same with the disturbance observer", 2.5, pairs, joints,
      [=] { return arm_controller(joints, pa10_with_drives(), observing); });
  add("control tick in task space, dmp3", 5.0, 1000, tool, [=] { return controller(tool, join); });
}

}  // namespace seam::micro
