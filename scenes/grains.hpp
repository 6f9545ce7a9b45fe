#pragma once

#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <seam/robot_model.hpp>

class btMultiBodyDynamicsWorld;

namespace seam {

/// A hollow cylinder with a floor, open at the top. Its frame: bottom centre, z its axis.
struct VesselSettings {
  double radius = 0.03;  // [m] inside
  double height = 0.14;  // [m] inside
  double wall = 0.004;   // [m] thickness
  double mass = 0.2;     // [kg]
};

/// The vessel as boxes: sixteen sides and the floor.
/// @throws Error  a value that is not finite and > 0
std::vector<Geometry> walls(const VesselSettings& vessel);

/// Gives a vessel to the hand of a robot: its walls collide and its mass is carried by the body of a link. The collision
/// shapes of the links fixed to the same body go, so that no finger reaches into the vessel.
/// @throws Error  no such link, or one that does not move
void add_vessel(RobotModel& robot, const std::string& link, const Eigen::Isometry3d& X_link_vessel,
                const VesselSettings& vessel);

/// A vessel that stands in a world, which is borrowed.
class StandingVessel {
 public:
  StandingVessel(btMultiBodyDynamicsWorld& world, const Eigen::Isometry3d& X_world_vessel,
                 const VesselSettings& vessel);
  ~StandingVessel();

  /// Whether a point of the world is inside.
  bool holds(const Eigen::Vector3d& point) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

struct GrainSettings {
  int count = 32;
  double radius = 0.005;  // [m]
  double mass = 0.0013;   // [kg] of each
  double friction = 0.3;
  double restitution = 0.1;
};

/// Grains in a world, which is borrowed: spheres that lie in layers in a vessel, a little shifted by chance.
class Grains {
 public:
  /// @throws Error  they do not fit, or a value is not finite and > 0
  Grains(btMultiBodyDynamicsWorld& world, const Eigen::Isometry3d& X_world_vessel,
         const VesselSettings& vessel, const GrainSettings& settings, int seed);
  ~Grains();

  int count() const noexcept;
  Eigen::Vector3d position(int grain) const;
  /// Share of the grains [0 to 1] that a vessel holds.
  double share_in(const StandingVessel& vessel) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seam
