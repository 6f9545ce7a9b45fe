// Metrics in your own test: records a run in memory and says in GoogleTest's words what it should be.
//     metrics_in_your_test pa10.urdf

#include <gmock/gmock.h>

#include "example.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>
#include <seam/testing.hpp>

namespace {

std::string urdf;

seam::Recording nod(seam::Join join) {
  World world;
  seam::Robot arm = seam::Robot::load(urdf, world.bullet);
  const Eigen::VectorXd straight = Eigen::VectorXd::Zero(1), bent = Eigen::VectorXd::Ones(1);
  seam::Sequence task;
  task.then(seam::learn(movement({"E1"}, straight, bent, 1.0))).until(seam::before_end(0.4));
  task.then(seam::learn(movement({"E1"}, bent, straight, 1.0)));
  seam::Controller controller(arm, task, join);
  seam::Plugin plugin(world.bullet);
  plugin.add(controller);

  std::vector<std::string> names;
  Eigen::VectorXd effort(arm.dof());
  for (const seam::Joint& joint : arm.model().joints) {
    effort(static_cast<Eigen::Index>(names.size())) = joint.effort;
    names.push_back(joint.name);
  }
  seam::Recording recording(names, effort, 1600);
  for (int k = 0; k < recording.ticks(); ++k) {
    world.bullet.stepSimulation(btScalar(1e-3), 0);
    const auto& tick = controller.last_tick();
    recording.time(k) = 1e-3 * k;
    recording.running(k) = tick.running;
    recording.ref.row(k) = tick.reference.position;
    recording.ref_vel.row(k) = tick.reference.velocity;
    recording.ref_acc.row(k) = tick.reference.acceleration;
    recording.q.row(k) = tick.q;
    recording.qd.row(k) = tick.qd;
    recording.torque.row(k) = tick.torque;
  }
  return recording;
}

}  // namespace

TEST(MyArm, HandsOverWithoutAStepInTorque) {
  const seam::Recording recording = nod(seam::Join::dmp3);
  EXPECT_THAT(recording, seam::TorqueIsContinuousAt(0.6).within(0.5 /*N·m*/));
  EXPECT_THAT(recording, seam::TracksWithin(sizeof(btScalar) == 8 ? 1e-9 : 1e-5 /*rad*/));
}

TEST(MyArm, WouldStepWithDmp2) {
  EXPECT_THAT(nod(seam::Join::dmp2), testing::Not(seam::TorqueIsContinuousAt(0.6).within(0.5)));
}

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  urdf = argc > 1 ? argv[1] : "pa10.urdf";
  return RUN_ALL_TESTS();
}
