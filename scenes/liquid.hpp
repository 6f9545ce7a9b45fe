#pragma once

#include <Eigen/Geometry>

#include <seam/robot.hpp>
#include <seam/robot_model.hpp>

namespace seam {

/// A liquid in an upright cylindrical glass.
struct LiquidSettings {
  double radius = 0.035;      // [m] R, inside
  double depth = 0.07;        // [m] h
  double rim = 0.010;         // [m] of the glass above the surface at rest
  double density = 1000.0;    // [kg/m³]
  double viscosity = 1.0e-6;  // [m²/s] kinematic
  double glass = 0.15;        // [kg] mass of the glass
};

/// Equivalent mechanical model of the first sloshing mode (H. N. Abramson, The Dynamic Behavior of Liquids in Moving
/// Containers, NASA SP-106, 1966, ch. 6; F. T. Dodge, its revision of 2000, ch. 3; R. A. Ibrahim, Liquid Sloshing
/// Dynamics, 2005, ch. 5): a mass m₁ on a spring, the rest fixed to the glass. With λ = 1.8412, the first zero of J₁′,
/// and t = tanh(λh/R)
///     ω² = (gλ/R)·t
///     m₁ = m·2R·t/(λh(λ² − 1)),  at z₁ = h − (2R/λ)·tanh(λh/2R) above the bottom
///     m₀ = m − m₁,  where it keeps the centre of mass at h/2
///     ζ = δ/2π,  δ = 4.98·ν^½·R^(−¾)·g^(−¼)·(1 + 0.318/sinh(λh/R)·(1 + (1 − h/R)/cosh(λh/R)))
/// The wave at the wall for a displacement X of m₁ is A = X·2λt/(λ² − 1), from r·cos θ in terms of
/// J₁(λr/R)/J₁(λ)·cos θ. Linear: good while A is small beside R. No surface tension, no swirl, no rotation of the liquid
/// about the glass's axis.
struct Slosh {
  double mass = 0.0;            // [kg] m, all of the liquid
  double frequency = 0.0;       // [rad/s] ω, undamped
  double damping = 0.0;         // ζ
  double modal_mass = 0.0;      // [kg] m₁
  double modal_height = 0.0;    // [m] z₁
  double wave_per_shift = 0.0;  // A/X

  /// @throws Error  a value that is not finite and > 0 (the rim and the glass's mass: ≥ 0)
  explicit Slosh(const LiquidSettings& liquid);
};

/// Glass and liquid of which nothing moves, in the frame of the glass: bottom centre, z its axis.
Inertial frozen(const LiquidSettings& liquid);

/// Adds glass and liquid to the body that carries a link. What moves of the liquid becomes the last two joints,
/// `slosh_x` and `slosh_y`: m₁ slides across the glass's axis; the spring is Liquid's.
/// @throws Error  no such link, and whatever Slosh refuses
void add_liquid(RobotModel& robot, const std::string& link, const Eigen::Isometry3d& X_link_glass,
                const LiquidSettings& liquid);
/// The same, frozen: what a controller takes the robot for that does not know of sloshing.
void add_frozen_liquid(RobotModel& robot, const std::string& link,
                       const Eigen::Isometry3d& X_link_glass, const LiquidSettings& liquid);

/// Share of the liquid [0 to 1] that stands above the rim's plane when the wave at the wall is A [m].
double share_above_rim(const LiquidSettings& liquid, double wave);

/// The spring and damper of a liquid that was added to a robot in Bullet, which is borrowed.
class Liquid {
 public:
  /// @param robot  with slosh_x and slosh_y as its last joints
  Liquid(Robot& robot, const LiquidSettings& settings);

  /// To be called once before each of Bullet's ticks. Neither allocates nor throws.
  void pre_tick() noexcept;
  /// Height of the wave at the wall [m], at the last tick's beginning.
  double wave() const noexcept { return waves_.norm(); }
  /// The same along the glass's x and y: the surface rises towards (x, y).
  const Eigen::Vector2d& waves() const noexcept { return waves_; }

 private:
  Robot& robot_;
  Slosh slosh_;
  Eigen::Vector2d waves_ = Eigen::Vector2d::Zero();  // [m]
};

}  // namespace seam
