#include "scenes/grains.hpp"

#include <cmath>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <gmock/gmock.h>

#include "scenes/world.hpp"
#include "tests/support.hpp"

namespace seam {
namespace {

const Eigen::Isometry3d somewhere(Eigen::Translation3d(0.4, -0.2, 0.3));

TEST(Grains, StayInAGlassThatStands) {
  World world;
  const VesselSettings settings;
  const StandingVessel glass(*world, somewhere, settings);
  const Grains grains(*world, somewhere, settings, {}, 1);
  ASSERT_EQ(grains.count(), 32);
  EXPECT_EQ(grains.share_in(glass), 1.0);
  for (int k = 0; k < 2000; ++k) world->stepSimulation(1e-3, 0);
  EXPECT_EQ(grains.share_in(glass), 1.0);
  // They lie at rest, none deeper in the floor than Bullet's contacts allow.
  for (int i = 0; i < grains.count(); ++i)
    EXPECT_GT(grains.position(i).z(), 0.3 + 0.005 - 1e-3) << i;
}

TEST(Grains, RunOutOfAGlassThatLies) {
  World world;
  const VesselSettings settings;
  const Eigen::Isometry3d lies = somewhere * Eigen::AngleAxisd(1.75, Eigen::Vector3d::UnitY());
  const StandingVessel glass(*world, lies, settings);
  const Grains grains(*world, lies, settings, {}, 1);
  for (int k = 0; k < 2000; ++k) world->stepSimulation(1e-3, 0);
  EXPECT_EQ(grains.share_in(glass), 0.0);
}

TEST(Grains, LieByChanceAndTheSameForASeed) {
  World world;
  const auto second = [&](int seed) { return Grains(*world, somewhere, {}, {}, seed).position(1); };
  EXPECT_EQ(second(1), second(1));
  EXPECT_NE(second(1), second(2));
}

TEST(Grains, LeaveTheWorldAsItWas) {
  World world;
  {
    const StandingVessel glass(*world, somewhere, {});
    const Grains grains(*world, somewhere, {}, {}, 1);
    EXPECT_EQ(world->getNumCollisionObjects(), 33);
  }
  EXPECT_EQ(world->getNumCollisionObjects(), 0);
}

TEST(Vessel, AddsItsMassToTheBodyThatCarriesIt) {
  RobotModel robot = RobotModel::read(std::string(SEAM_ASSETS) + "/pa10/pa10.urdf");
  const double before = robot.bodies.back().inertial.mass;
  add_vessel(robot, "tool", Eigen::Isometry3d::Identity(), {});
  EXPECT_NEAR(robot.bodies.back().inertial.mass, before + 0.2, 1e-12);
  EXPECT_EQ(robot.bodies.back().collisions.size(), 17U);
}

TEST(Vessel, RefusesWhatCannotBe) {
  VesselSettings vessel;
  vessel.wall = 0.0;
  EXPECT_EQ(test::refusal([&] { walls(vessel); }), "vessel: wall 0.000000, must be > 0");
  vessel.wall = std::nan("");
  EXPECT_EQ(test::refusal([&] { walls(vessel); }), "vessel: wall nan, must be > 0");
}

}  // namespace
}  // namespace seam
