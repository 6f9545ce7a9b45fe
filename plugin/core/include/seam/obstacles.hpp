#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/coupling.hpp>
#include <seam/export.hpp>
#include <seam/glide.hpp>

namespace SEAM_API seam {

class Sequencer;

/// A point that a moving tool steers round (Hoffmann, Park, Pastor and Schaal 2009), windowed:
///     C = γ·Rẏ·φ·exp(−βφ)·W(|o − y|)
/// φ is the angle between ẏ and the way o − y to the point, R a quarter turn about (o − y) × ẏ: away from the point, at
/// right angles to the motion, which it makes neither faster nor slower. Finite also where φ = 0 it reads
///     C = −γ·|ẏ|·exp(−βφ)·(φ/sin φ)·n/|o − y|·W,   n: what of o − y is across ẏ
/// W falls from 1 at half the reach to 0 at the reach, by the quintic; and for φ > π/2, where the point is behind and the
/// paper leaves a trace, C falls to 0 at φ = π in the same way. C is 0 where the tool stands, where it heads straight for
/// the point (so it does not steer there), and at the point. It bends where ẏ passes through 0, its second derivative
/// steps where φ does; elsewhere it has two continuous derivatives. The paper's β is 20/π, which leaves less room.
struct Steering {
  double strength = 1000.0;        // γ [1/(rad·s)] ≥ 0
  double sharpness = 10.0 / M_PI;  // β [1/rad] ≥ 0: C is strongest at φ = 1/β
  double reach = 0.4;              // [m] > 0, where W has fallen to 0
};

/// A ball that pushes a tool away, with the potential
///     U = s·L/4·(1 − d/L)⁴,   C = −∇U = s·(1 − d/L)³ away from the ball,   0 for d ≥ L
/// d [m] is the distance from its surface, negative inside, L the reach. At the reach C ends with its first two derivatives.
/// A tool that comes with v gets to where v²/2 = U, if nothing else drives it.
struct Ball {
  double radius = 0.05;     // [m] > 0
  double strength = 200.0;  // s [m/s²] ≥ 0, at the surface
  double reach = 0.1;       // L [m] > 0, from the surface
};

/// A box that pushes likewise. d⁴ = Σe⁴ of the amounts e ≥ 0 by which the tool is beyond its sides along its own three
/// axes: the distance before a side, and less than it, by a fourth at the most, off edges and corners; so C has two
/// continuous derivatives everywhere outside. Inside d is minus the distance from the nearest side, and C changes its
/// direction where another side becomes the nearest. A tool that heads squarely for a side stops before it; it does not
/// find a way round.
struct Box {
  Eigen::Vector3d size = {0.1, 0.1, 0.1};                           // [m] > 0, edge lengths
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of unit length
  double strength = 200.0;  // s [m/s²] ≥ 0, at the surface
  double reach = 0.1;       // L [m] > 0, from the surface
};

/// An obstacle's change, as a file says it.
struct Fading {
  double from = 0.0;  // [s] of the motion's own time
  double over = 0.3;  // [s] how long it takes
};

/// An obstacle's move, as a file says it.
struct Moving {
  Eigen::Vector3d to = Eigen::Vector3d::Zero();  // [m]
  double from = 0.0;                             // [s] of the motion's own time
  double over = 1.0;                             // [s] how long it takes
};

/// What an obstacle is, as a value.
struct ObstacleSettings {
  Eigen::Vector3d at =
      Eigen::Vector3d::Zero();              // [m] its centre, in the frame of the coordinates x y z
  std::variant<Steering, Ball, Box> shape;  // and what it does
  std::optional<Fading> appears = std::nullopt;   // there from the beginning without
  std::optional<Fading> vanishes = std::nullopt;  // stays without
  std::optional<Moving> moves = std::nullopt;     // stands without

  /// The same for a motion that is faster by a factor, which it leaves on its path: times are divided by it, γ is
  /// multiplied by it, s by its square.
  ObstacleSettings at_speed(double factor) const;
};

/// An obstacle to a tool with the coordinates x y z; or x y in a plane, where z is taken to be the obstacle's. It can appear,
/// move and vanish while the motion runs, each over a time and without a step in C: strength and position are a Glide
/// each, of the motion's own time. It is the tool's point that keeps away, not the arm's links.
///
///     auto ball = std::make_shared<Obstacle>(task.coordinates(), ObstacleSettings{{0.4, 0, 0.3}, Ball{}});
///     sequencer.add_coupling(ball);
///     ball->move(seen, sequencer.motion_time(), 0.1);        // 30 times a second
///
/// Construction allocates, nothing else does, nor throws. Changes are made between steps, by the thread that steps.
class Obstacle : public Coupling {
 public:
  /// @param coordinates  of the sequence; those named x, y and z are the tool's, others are left alone
  /// @throws Error  x or y is not among them; a number that is not finite or out of its range
  Obstacle(const std::vector<std::string>& coordinates, const ObstacleSettings& settings);

  /// Appears, or is there again, from a time on and over a time [s of the motion]. False, and no change, where Glide refuses.
  bool appear(double from, double over) noexcept { return presence_.move(1.0, from, over); }
  /// Vanishes likewise.
  bool vanish(double from, double over) noexcept { return presence_.move(0.0, from, over); }
  /// Moves to a position likewise. @param to  [m] its centre
  bool move(const Eigen::Vector3d& to, double from, double over) noexcept {
    return position_.move(to, from, over);
  }

  /// Where its centre is at a time [m].
  Eigen::Vector3d position(double time) const noexcept { return position_.value(time); }
  /// How much of its strength it has at a time: 0 to 1.
  double presence(double time) const noexcept { return presence_.value(time); }
  /// d of a tool at a time [m]: from its surface, of a Steering from the point. @param tool  x y z [m]
  double distance(const Eigen::Vector3d& tool, double time) const noexcept;
  /// U of a tool at a time [m²/s²], with the presence; of a Steering 0.
  double potential(const Eigen::Vector3d& tool, double time) const noexcept;
  void add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
           Eigen::VectorXd& ydd) const noexcept override;

 private:
  std::variant<Steering, Ball, Box> shape_;
  Glide<Eigen::Vector3d> position_;
  Glide<double> presence_;
  Eigen::Index x_, y_, z_;  // among the coordinates; z −1 in a plane
};

/// Makes obstacles of what a file says and adds them to what plays it, best before the first step.
/// @return  the obstacles in the same order
/// @throws Error  see Obstacle
std::vector<std::shared_ptr<Obstacle>> add_obstacles(const std::vector<ObstacleSettings>& all,
                                                     Sequencer& sequencer);

}  // namespace seam
