// seam::bullet-float32: what is left of the accuracy where Bullet computes in float.
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gmock/gmock.h>

#include "plugin/examples/example.hpp"
#include "tests/allocation_guard.hpp"
#include "tests/random_robot.hpp"
#include "tests/temp_folder.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

namespace {

using Eigen::VectorXd;

static_assert(sizeof(btScalar) == 4, "the float build of Bullet");

// The bars, as the README states them.
constexpr double acceleration_bar =
    2e-3;  // [rad/s²] at velocities to 4 rad/s, accelerations to 30 rad/s²
constexpr double tracking_bar = 1e-6;  // [rad]
constexpr double joining_bar = 0.02;   // torque jump of dmp2's

seam::RobotSettings tilted() {
  seam::RobotSettings settings;
  settings.X_world_base.translate(Eigen::Vector3d(0.5, -0.2, 1.0));
  settings.X_world_base.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  settings.self_collision = false;
  return settings;
}

/// One joint or all from zero to a place and back, handing over while they move.
struct Played {
  double tracking = 0.0;  // [rad] max
  double torque_jump = 0.0;
};

Played there_and_back(const seam::RobotModel& model, seam::Join join, int substeps = 1) {
  World world;
  seam::Robot arm(model, world.bullet, tilted());
  std::vector<std::string> names;
  VectorXd from(arm.dof()), to(arm.dof());
  for (const seam::Joint& joint : arm.model().joints) {
    const auto i = static_cast<Eigen::Index>(names.size());
    const bool endless = joint.type == seam::Joint::Type::continuous;
    from(i) = endless ? 0.0 : 0.5 * (joint.lower + joint.upper);
    to(i) = from(i) + (endless ? 0.5 : std::min(0.5, 0.1 * (joint.upper - joint.lower)));
    names.push_back(joint.name);
  }
  arm.reset(from, VectorXd::Zero(arm.dof()));
  seam::Sequence task;
  task.then(seam::learn(movement(names, from, to, 1.5)))
      .until(seam::before_end(0.5))
      .then(seam::learn(movement(names, to, from, 1.5)));
  seam::Controller controller(arm, task, join);
  seam::Plugin plugin(world.bullet);
  plugin.add(controller);

  Played run;
  const int ticks = 2500;
  VectorXd time(ticks);
  Eigen::MatrixXd torque(ticks, arm.dof());
  for (int k = 0; k < ticks; ++k) {
    if (substeps == 1)
      world.bullet.stepSimulation(btScalar(1e-3), 0);
    else if (k % substeps == 0)
      world.bullet.stepSimulation(btScalar(1e-3 * substeps), substeps, btScalar(1e-3));
    const auto& tick = controller.last_tick();
    run.tracking =
        std::max(run.tracking, (tick.q - tick.reference.position).lpNorm<Eigen::Infinity>());
    time(k) = 1e-3 * k;
    torque.row(k) = tick.torque;
  }
  if (substeps == 1) run.torque_jump = seam::jump(time, torque, 1.0).lpNorm<Eigen::Infinity>();
  return run;
}

Played there_and_back(const std::string& urdf, seam::Join join, int substeps = 1) {
  return there_and_back(seam::RobotModel::read(urdf), join, substeps);
}

double worst_acceleration_error(const std::string& urdf, double range = 3.0) {
  World world;
  seam::Robot arm = seam::Robot::load(urdf, world.bullet, tilted());
  seam::InverseDynamics dynamics(arm.model());
  dynamics.set_gravity(arm.gravity_in_base());
  RandomRobot random(5);
  double worst = 0.0;
  VectorXd torque(arm.dof()), q(arm.dof()), before(arm.dof()), after(arm.dof());
  for (int i = 0; i < 1000; ++i) {
    const VectorXd qdd = random.vector(arm.dof(), 30.0);
    arm.reset(random.vector(arm.dof(), range), random.vector(arm.dof(), 4.0));
    arm.state(q, before);  // as rounded
    dynamics.torque(q, before, qdd, torque);
    for (int j = 0; j < arm.dof(); ++j)
      arm.multibody().addJointTorque(j, static_cast<btScalar>(torque(j)));
    const double dt = 1e-2;
    world.bullet.stepSimulation(btScalar(dt), 0);
    arm.state(q, after);
    worst = std::max(worst, ((after - before) / dt - qdd).lpNorm<Eigen::Infinity>());
  }
  std::cout << urdf << ": " << worst << " rad/s^2\n";
  return worst;
}

class Float32 : public testing::TestWithParam<std::string> {};

TEST_P(Float32, AcceleratesAsItsInverseDynamicsAsks) {
  const double worst = worst_acceleration_error(GetParam());
  RecordProperty("acceleration_error", std::to_string(worst));
  EXPECT_LE(worst, acceleration_bar);
}

// Links beyond the triangle rule, sensors with negative moments, points that become balls; in the neck's limits, within
// which its joints do not line up.
TEST(Float32OfOddUrdfs, AcceleratesAsItsInverseDynamicsAsks) {
  const std::string robots = SEAM_TEST_DATA "/robots/";
  EXPECT_LE(worst_acceleration_error(robots + "odd_arm.urdf"), acceleration_bar);
  EXPECT_LE(worst_acceleration_error(robots + "point_masses.urdf", 0.6), acceleration_bar);
}

TEST(Float32OfOddUrdfs, NamesAJointThatBulletDoesNotMove) {
  const TempFolder folder;
  const auto warnings = [&](const std::string& moment) {
    const std::string file = folder.write(
        "x.urdf", R"(<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1e-3"/>)"
                  R"(<inertia ixy="0" ixz="0" iyz="0" ixx=")" +
                      moment + R"(" iyy=")" + moment + R"(" izz=")" + moment +
                      R"("/></inertial></link><joint name="j" type="continuous"><parent link="a"/>)"
                      R"(<child link="b"/></joint></robot>)");
    World world;
    return seam::Robot::load(file, world.bullet).model().warnings;
  };
  EXPECT_THAT(warnings("2e-7"), testing::IsEmpty());
  EXPECT_THAT(warnings("1e-8"),
              testing::ElementsAre(R"(joint "j": moves an inertia of 1e-08 kg m^2, must be >= )"
                                   "1.19209e-07 in this precision: Bullet does not move it"));
}

TEST_P(Float32, FollowsItsSequence) {
  for (const seam::Join join : seam::all_joins) {
    const Played run = there_and_back(GetParam(), join);
    std::cout << to_string(join) << ": " << run.tracking << " rad\n";
    EXPECT_LE(run.tracking, tracking_bar) << to_string(join);
  }
}

TEST_P(Float32, FollowsItsSequenceInSubsteps) {
  EXPECT_LE(there_and_back(GetParam(), seam::Join::dmp3, 4).tracking, tracking_bar);
}

TEST_P(Float32, JoinsWithoutAStepInTorque) {
  const double step = there_and_back(GetParam(), seam::Join::dmp2).torque_jump;
  for (const seam::Join join : {seam::Join::dmp2a, seam::Join::dmp3, seam::Join::dmp2j}) {
    const Played run = there_and_back(GetParam(), join);
    std::cout << to_string(join) << ": " << run.torque_jump << " of " << step << " N·m\n";
    EXPECT_LE(run.torque_jump, joining_bar * step) << to_string(join);
  }
}

TEST_P(Float32, FollowsItsSequenceWithRotorsAndFriction) {
  seam::RobotModel model = seam::RobotModel::read(GetParam());
  for (seam::Joint& joint : model.joints) {
    joint.rotor_inertia = 0.1;
    joint.damping = 3.0;
  }
  for (const int substeps : {1, 4})
    EXPECT_LE(there_and_back(model, seam::Join::dmp3, substeps).tracking, 10.0 * tracking_bar);
  for (seam::Joint& joint : model.joints) joint.friction = 1.0;
  EXPECT_LE(there_and_back(model, seam::Join::dmp3).tracking, 0.05);
}

TEST_P(Float32, NeitherAllocatesNorThrowsInATick) {
  World world;
  seam::Robot arm = seam::Robot::load(GetParam(), world.bullet, tilted());
  VectorXd q(arm.dof()), qd(arm.dof());
  arm.state(q, qd);
  const std::string name = arm.model().joints[1].name;
  const VectorXd here = q.segment(1, 1), there = here.array() + 0.1;
  seam::Sequence task;
  task.then(seam::learn(movement({name}, here, there, 1.0)));
  seam::Controller controller(arm, task, seam::Join::dmp3);
  controller.pre_tick(1e-3);
  const AllocationGuard guard;
  for (int k = 0; k < 100; ++k) controller.pre_tick(1e-3);
  EXPECT_EQ(guard.allocations(), 0);
}

INSTANTIATE_TEST_SUITE_P(, Float32,
                         testing::Values(SEAM_ASSETS "/pa10/pa10.urdf",
                                         SEAM_TEST_DATA "/lift_arm.urdf",
                                         SEAM_TEST_DATA "/skew_tree.urdf"));

TEST(Float32OfMeshes, HullsHaveFewVerticesAndBodiesThatNeverMeetAreLeftOut) {
  seam::RobotModel model = seam::RobotModel::read(SEAM_ASSETS "/pa10/pa10.urdf");
  model.base.collisions = {model.base.visuals.front()};  // a mesh
  World world;
  seam::Robot arm(model, world.bullet);
  const auto& compound =
      static_cast<const btCompoundShape&>(*arm.multibody().getBaseCollider()->getCollisionShape());
  const auto& hull = static_cast<const btConvexHullShape&>(*compound.getChildShape(0));
  EXPECT_LT(hull.getNumPoints(), 120);
  const auto* third = arm.multibody().getLinkCollider(2);
  EXPECT_FALSE(third->checkCollideWith(arm.multibody().getLinkCollider(4)));
}

}  // namespace
