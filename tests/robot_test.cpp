#include <cmath>
#include <cstdio>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <InverseDynamics/btMultiBodyTreeCreator.hpp>
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include "scenes/world.hpp"
#include "tests/allocation_guard.hpp"
#include "tests/kdl_robot.hpp"
#include "tests/random_robot.hpp"
#include "tests/temp_folder.hpp"
#include <seam/error.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/robot.hpp>

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const std::string pa10 = SEAM_ASSETS "/pa10/pa10.urdf";
const std::string skew_tree = SEAM_TEST_DATA "/skew_tree.urdf";
const std::string planar_arm = SEAM_TEST_DATA "/planar_arm.urdf";
const std::string shapes = SEAM_TEST_DATA "/shapes.urdf";

seam::RobotSettings without_colliders(const Isometry3d& X_world_base = Isometry3d::Identity()) {
  seam::RobotSettings settings;
  settings.X_world_base = X_world_base;
  settings.colliders = false;
  return settings;
}

std::vector<std::string> joint_names(const seam::RobotModel& model) {
  std::vector<std::string> names;
  for (const auto& joint : model.joints) names.push_back(joint.name);
  return names;
}

/// Base poses: upright, hung from the ceiling, on either wall, and two at random.
std::vector<Isometry3d> base_poses(RandomRobot& random) {
  std::vector<Isometry3d> poses(4, Isometry3d::Identity());
  poses[1].rotate(Eigen::AngleAxisd(M_PI, Vector3d::UnitX()));
  poses[2].rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
  poses[3].rotate(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitY()));
  poses.push_back(random.pose());
  poses.push_back(random.pose());
  return poses;
}

/// The acceleration that one step of the world gives under these torques.
VectorXd acceleration_of_a_step(seam::Robot& robot, const VectorXd& torque) {
  const double dt = 1e-2;
  VectorXd q(robot.dof()), before(robot.dof()), after(robot.dof());
  robot.state(q, before);
  for (int i = 0; i < robot.dof(); ++i) robot.multibody().addJointTorque(i, btScalar(torque[i]));
  robot.world().stepSimulation(btScalar(dt), 0);
  robot.state(q, after);
  return (after - before) / dt;
}

/// Largest |q̈ asked of the inverse dynamics − q̈ that Bullet then makes| [rad/s² or m/s²].
double worst_acceleration_error(const std::string& urdf, RandomRobot& random, int states) {
  double worst = 0.0;
  for (const Isometry3d& X_world_base : base_poses(random)) {
    seam::World world;
    auto robot = seam::Robot::load(urdf, *world, without_colliders(X_world_base));
    seam::InverseDynamics dynamics(robot.model());
    dynamics.set_gravity(robot.gravity_in_base());
    VectorXd torque(robot.dof());
    for (int i = 0; i < states; ++i) {
      const VectorXd q = random.vector(robot.dof(), 3.0);
      const VectorXd qd = random.vector(robot.dof(), 4.0);
      const VectorXd qdd = random.vector(robot.dof(), 30.0);
      robot.reset(q, qd);
      dynamics.torque(q, qd, qdd, torque);
      worst = std::max(worst, (acceleration_of_a_step(robot, torque) - qdd).cwiseAbs().maxCoeff());
    }
  }
  return worst;
}

class RobotOf : public testing::TestWithParam<std::string> {};

TEST_P(RobotOf, AcceleratesAsItsInverseDynamicsAsksOnAnyBase) {
  const unsigned seed = 21;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomRobot random(seed);
  const double worst = worst_acceleration_error(GetParam(), random, 1000);
  std::printf("worst acceleration error %.2g rad/s^2\n", worst);
  EXPECT_LE(worst, 1e-9);
}

TEST_P(RobotOf, AgreesWithTheTreeThatBulletMakesFromItsMultibody) {
  namespace id = btInverseDynamics;
  seam::World world;
  const auto robot = seam::Robot::load(GetParam(), *world, without_colliders());
  const seam::InverseDynamics dynamics(robot.model());
  id::btMultiBodyTreeCreator creator;
  ASSERT_EQ(creator.createFromBtMultiBody(&robot.multibody(), false), 0);
  const std::unique_ptr<id::MultiBodyTree> tree(id::CreateMultiBodyTree(creator));
  tree->setGravityInWorldFrame(world->getGravity());

  const unsigned seed = 22;
  RandomRobot random(seed);
  const int n = robot.dof();
  for (int state = 0; state < 200; ++state) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", state " + std::to_string(state));
    id::vecx x[3] = {id::vecx(n), id::vecx(n), id::vecx(n)}, theirs(n);
    const VectorXd q = random.vector(n, 3.0), qd = random.vector(n, 4.0),
                   qdd = random.vector(n, 30.0);
    for (int i = 0; i < n; ++i)
      x[0](i) = btScalar(q[i]), x[1](i) = btScalar(qd[i]), x[2](i) = btScalar(qdd[i]);
    ASSERT_EQ(tree->calculateInverseDynamics(x[0], x[1], x[2], &theirs), 0);
    VectorXd ours(n);
    dynamics.torque(q, qd, qdd, ours);
    const double scale = ours.cwiseAbs().maxCoeff();
    for (int i = 0; i < n; ++i) EXPECT_NEAR(ours[i], theirs(i), 1e-10 * scale);
  }
}

TEST_P(RobotOf, PlacesEveryLinkWhereOrocosKdlDoes) {
  const unsigned seed = 23;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomRobot random(seed);
  const KdlRobot kdl(GetParam());
  for (const Isometry3d& X_world_base : base_poses(random)) {
    seam::World world;
    auto robot = seam::Robot::load(GetParam(), *world, without_colliders(X_world_base));
    for (int state = 0; state < 20; ++state) {
      const VectorXd q = random.vector(robot.dof(), 3.0);
      robot.reset(q, VectorXd::Zero(robot.dof()));
      for (const auto& frame : robot.model().frames) {
        const Isometry3d expected =
            X_world_base * kdl.pose(joint_names(robot.model()), q, frame.name);
        EXPECT_LE((robot.X_world_frame(frame).matrix() - expected.matrix()).cwiseAbs().maxCoeff(),
                  1e-12);
      }
    }
  }
}

// Links beyond the triangle rule, sensors with negative moments, points that become balls.
TEST(Robot, AcceleratesAsAskedWhereItsUrdfIsOdd) {
  for (const char* file : {"/robots/odd_arm.urdf", "/robots/point_masses.urdf"}) {
    RandomRobot random(25);
    EXPECT_LE(worst_acceleration_error(std::string(SEAM_TEST_DATA) + file, random, 100), 1e-9)
        << file;
  }
}

TEST(Robot, KeepsTheWarningsOfItsUrdfAndPrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::string file = SEAM_TEST_DATA "/robots/odd_arm.urdf";
  seam::World world;
  const auto robot = seam::Robot::load(file, *world);
  EXPECT_EQ(robot.model().warnings.size(), 10U);
  EXPECT_EQ(robot.model().warnings, seam::RobotModel::read(file).warnings);
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(Files, RobotOf, testing::Values(pa10, skew_tree, planar_arm));

TEST(Robot, AcceleratesAsAskedOnRandomTrees) {
  const TempFolder folder;
  double worst = 0.0;
  for (unsigned seed = 200; seed < 240; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomRobot random(seed);
    const std::string file = folder.write("random.urdf", random.urdf(random.integer(2, 14)));
    const double error = worst_acceleration_error(file, random, 20);
    worst = std::max(worst, error);
    EXPECT_LE(error, 1e-9);
  }
  std::printf("worst acceleration error %.2g rad/s^2\n", worst);
}

// Free of motors and damping, a swinging tree keeps its energy up to the integrator's error, which
// is of order dt.
TEST(Robot, LosesNoEnergyAsItSwings) {
  const auto drift = [](double dt) {
    seam::World world;
    auto robot = seam::Robot::load(SEAM_TEST_DATA "/pendulum.urdf", *world, without_colliders());
    robot.reset(VectorXd::Constant(1, 2.0), VectorXd::Zero(1));
    VectorXd q(1), qd(1);
    for (int i = 0; i < std::lround(10.0 / dt); ++i) world->stepSimulation(btScalar(dt), 0);
    robot.state(q, qd);
    const double energy = 0.5 * 0.53 * qd[0] * qd[0] - 2.0 * 9.81 * 0.5 * std::cos(q[0]);
    return std::abs(energy + 2.0 * 9.81 * 0.5 * std::cos(2.0));
  };
  EXPECT_LE(drift(1e-3), 0.1);
  EXPECT_LE(drift(1e-4), 0.01);
}

TEST(Robot, StaysAwakeWithoutMotion) {
  seam::World world;
  auto robot = seam::Robot::load(shapes, *world);
  world->setGravity(btVector3(0, 0, 0));
  for (int i = 0; i < 5000; ++i) world->stepSimulation(btScalar(1e-3), 0);
  robot.multibody().addJointTorque(0, btScalar(1));
  world->stepSimulation(btScalar(1e-3), 0);
  EXPECT_GT(robot.multibody().getJointVel(0), 0.0);
}

/// The point where a ray from outside towards the shape's centre, along its own axis, first hits
/// anything.
Vector3d hit_along(btMultiBodyDynamicsWorld& world, const Isometry3d& X_world_shape,
                   const Vector3d& axis) {
  const Vector3d from = X_world_shape * (0.6 * axis);
  const btVector3 start(from.x(), from.y(), from.z());
  const Vector3d centre = X_world_shape.translation();
  const btVector3 end(centre.x(), centre.y(), centre.z());
  btCollisionWorld::ClosestRayResultCallback ray(start, end);
  world.rayTest(start, end, ray);
  if (!ray.hasHit()) return Vector3d::Constant(NAN);
  return X_world_shape.inverse() *
         Vector3d(ray.m_hitPointWorld.x(), ray.m_hitPointWorld.y(), ray.m_hitPointWorld.z());
}

TEST(Robot, PutsItsShapesWhereTheUrdfSaysOnARotatedBase) {
  const unsigned seed = 24;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomRobot random(seed);
  const KdlRobot kdl(shapes);
  for (const Isometry3d& X_world_base : base_poses(random)) {
    seam::World world;
    seam::RobotSettings settings;
    settings.X_world_base = X_world_base;
    auto robot = seam::Robot::load(shapes, *world, settings);
    const VectorXd q = random.vector(robot.dof(), 0.5);
    robot.reset(q, VectorXd::Zero(robot.dof()));
    const auto hit = [&](const std::string& link, const Vector3d& axis) {
      return hit_along(*world, X_world_base * kdl.pose(joint_names(robot.model()), q, link), axis);
    };
    const double accuracy = 2e-3;
    EXPECT_LE((hit("box", Vector3d::UnitX()) - Vector3d(0.05, 0, 0)).norm(), accuracy);
    EXPECT_LE((hit("box", -Vector3d::UnitY()) - Vector3d(0, -0.1, 0)).norm(), accuracy);
    EXPECT_LE((hit("box", Vector3d::UnitZ()) - Vector3d(0, 0, 0.15)).norm(), accuracy);
    EXPECT_LE((hit("cylinder", Vector3d::UnitY()) - Vector3d(0, 0.06, 0)).norm(), accuracy);
    EXPECT_LE((hit("cylinder", Vector3d::UnitZ()) - Vector3d(0, 0, 0.2)).norm(), accuracy);
    EXPECT_LE((hit("sphere", -Vector3d::UnitX()) - Vector3d(-0.09, 0, 0)).norm(), accuracy);
    EXPECT_LE((hit("hull", Vector3d::UnitX()) - Vector3d(0.1, 0, 0)).norm(), accuracy);
    EXPECT_LE((hit("hull", Vector3d::UnitZ()) - Vector3d(0, 0, 0.3)).norm(), accuracy);
  }
}

/// Whether a ball of 10 mm here would touch anything.
bool touches(btMultiBodyDynamicsWorld& world, const Vector3d& at) {
  struct Callback : btCollisionWorld::ContactResultCallback {
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      touched = touched || point.getDistance() <= 0;
      return 0;
    }
    bool touched = false;
  } callback;
  btSphereShape shape(btScalar(0.01));
  btCollisionObject ball;
  ball.setCollisionShape(&shape);
  ball.setWorldTransform(
      btTransform(btQuaternion::getIdentity(), btVector3(at.x(), at.y(), at.z())));
  world.contactTest(&ball, callback);
  return callback.touched;
}

TEST(Robot, CollidesAsBulletsCapsuleAlongZ) {
  const TempFolder folder;
  const std::string file = folder.write(
      "x.urdf",
      R"(<robot name="r"><link name="a"><collision><origin xyz="0.1 0 0" rpy="0.3 0 0"/>)"
      R"(<geometry><capsule radius="0.1" length="0.4"/></geometry></collision></link></robot>)");
  seam::World world;
  const auto robot = seam::Robot::load(file, *world);
  Isometry3d X_world_shape = Isometry3d::Identity();
  X_world_shape.translate(Vector3d(0.1, 0.0, 0.0));
  X_world_shape.rotate(Eigen::AngleAxisd(0.3, Vector3d::UnitX()));
  const Vector3d outwards[] = {Vector3d::UnitZ(), -Vector3d::UnitZ(), Vector3d::UnitX(),
                               -Vector3d::UnitY(), Vector3d(0.6, 0.0, 0.8)};
  for (const Vector3d& n : outwards) {
    const Vector3d centre(0.0, 0.0, n.z() == 0.0 ? 0.0 : std::copysign(0.2, n.z()));
    EXPECT_TRUE(touches(*world, X_world_shape * (centre + 0.109 * n))) << n.transpose();
    EXPECT_FALSE(touches(*world, X_world_shape * (centre + 0.111 * n))) << n.transpose();
  }
}

/// Links (−1: the base) of the robot that touch each other after one step, as "i-j" with i < j.
std::string touching(btMultiBodyDynamicsWorld& world) {
  world.stepSimulation(btScalar(1e-6), 0);
  std::string pairs;
  for (int i = 0; i < world.getDispatcher()->getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *world.getDispatcher()->getManifoldByIndexInternal(i);
    const auto* a = btMultiBodyLinkCollider::upcast(manifold.getBody0());
    const auto* b = btMultiBodyLinkCollider::upcast(manifold.getBody1());
    if (manifold.getNumContacts() == 0 || !a || !b) continue;
    pairs += std::to_string(std::min(a->m_link, b->m_link)) + "-" +
             std::to_string(std::max(a->m_link, b->m_link)) + " ";
  }
  return pairs;
}

/// A base and two links, each a ball of 0.1 m, all in one place.
std::string three_balls() {
  const std::string ball =
      R"(<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)"
      R"(<collision><geometry><sphere radius="0.1"/></geometry></collision></link>)";
  const auto joint = [](const std::string& parent, const std::string& child) {
    return R"(<joint name="to_)" + child + R"(" type="continuous"><parent link=")" + parent +
           R"("/><child link=")" + child + R"("/></joint>)";
  };
  return R"(<robot name="balls"><link name="a">)" + ball + R"(<link name="b">)" + ball +
         R"(<link name="c">)" + ball + joint("a", "b") + joint("b", "c") + "</robot>";
}

TEST(Robot, CollidesWithItselfExceptBetweenNeighbours) {
  const TempFolder folder;
  const std::string file = folder.write("balls.urdf", three_balls());
  seam::World world;
  {
    const auto robot = seam::Robot::load(file, *world);
    EXPECT_EQ(touching(*world), "-1-1 ");
  }
  seam::RobotSettings settings;
  settings.self_collision = false;
  const auto robot = seam::Robot::load(file, *world, settings);
  EXPECT_EQ(touching(*world), "");
}

TEST(Robot, DoesNotTouchItselfAsThePa10StandsUpright) {
  seam::World world;
  const auto robot = seam::Robot::load(pa10, *world);
  EXPECT_EQ(touching(*world), "");
}

TEST(Robot, CarriesWhatFallsOnItsBase) {
  seam::World world;
  const auto robot = seam::Robot::load(shapes, *world);
  btSphereShape shape(btScalar(0.05));
  btRigidBody ball(
      btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &shape, btVector3(1, 1, 1)));
  ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.3))));
  world->addRigidBody(&ball);
  for (int i = 0; i < 1000; ++i) world->stepSimulation(btScalar(1e-3), 0);
  EXPECT_NEAR(ball.getWorldTransform().getOrigin().z(), 0.1 + 0.05, 5e-3);
  world->removeRigidBody(&ball);
}

TEST(Robot, LeavesTheWorldEmptyWhenItIsDestroyed) {
  seam::World world;
  {
    seam::Robot first = seam::Robot::load(shapes, *world);
    seam::Robot second = std::move(first);
    const seam::Robot third = seam::Robot::load(skew_tree, *world);
    second = seam::Robot::load(pa10, *world);
    world->stepSimulation(btScalar(1e-3), 0);
    EXPECT_EQ(world->getNumMultibodies(), 2);
    EXPECT_EQ(world->getNumCollisionObjects(), 8 + 2);  // colliders, and a mark of each robot's
  }
  EXPECT_EQ(world->getNumMultibodies(), 0);
  EXPECT_EQ(world->getNumCollisionObjects(), 0);
  EXPECT_EQ(world->getDispatcher()->getNumManifolds(), 0);
}

TEST(Robot, LeavesTheWorldAloneWhenAMeshCannotBeRead) {
  const TempFolder folder;
  folder.write("m.obj", "v 0 0 nonsense\n");
  const std::string file = folder.write(
      "x.urdf",
      R"(<robot name="r"><link name="a"><collision><geometry><mesh filename="m.obj"/></geometry></collision></link></robot>)");
  seam::World world;
  EXPECT_THROW(seam::Robot::load(file, *world), seam::Error);
  EXPECT_EQ(world->getNumMultibodies(), 0);
  EXPECT_EQ(world->getNumCollisionObjects(), 0);
}

TEST(Robot, GivesBackTheStateItIsResetTo) {
  seam::World world;
  auto robot = seam::Robot::load(skew_tree, *world);
  const VectorXd q = VectorXd::LinSpaced(robot.dof(), -0.3, 0.3),
                 qd = VectorXd::LinSpaced(robot.dof(), 1.0, 2.0);
  robot.reset(q, qd);
  VectorXd q_now(robot.dof()), qd_now(robot.dof());
  robot.state(q_now, qd_now);
  EXPECT_EQ(q_now, q);
  EXPECT_EQ(qd_now, qd);
}

TEST(Robot, AllocatesNothingWhenAskedForItsState) {
  seam::World world;
  auto robot = seam::Robot::load(pa10, *world);
  const seam::Frame& tool = robot.model().frame("tool");
  VectorXd q(7), qd(7);
  double sum = 0.0;
  const AllocationGuard guard;
  robot.state(q, qd);
  sum += robot.X_world_frame(tool).translation().norm() + robot.gravity_in_base().norm();
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_GT(sum, 9.0);
}

TEST(Robot, TellsGravityInItsBase) {
  seam::World world;
  Isometry3d on_the_wall = Isometry3d::Identity();
  on_the_wall.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
  const auto robot = seam::Robot::load(planar_arm, *world, without_colliders(on_the_wall));
  EXPECT_LE((robot.gravity_in_base() - Vector3d(0, -9.81, 0)).norm(), 1e-14);
}

TEST(Robot, MayHaveNoJoints) {
  const TempFolder folder;
  seam::World world;
  const std::string file = folder.write(
      "t.urdf",
      R"(<robot name="table"><link name="top"><collision><geometry><box size="1 1 0.1"/></geometry></collision></link></robot>)");
  auto robot = seam::Robot::load(file, *world);
  EXPECT_EQ(robot.dof(), 0);
  world->stepSimulation(btScalar(1e-3), 0);
  EXPECT_EQ(robot.X_world_frame(robot.model().frame("top")).matrix(), Eigen::Matrix4d::Identity());
}

}  // namespace
