#pragma once

#include <memory>

#include <Eigen/Core>

namespace seam {

class Object;
class Robot;
class YamlEntry;
struct Scene;

/// A ball that is thrown and flies freely, or is carried along a line, for a hand to catch.
struct FlyingBall {
  double radius = 0.03;                          // [m]
  double thrown = 0.0;                           // [s] since the run began; until then it rests
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // [m] in the world, when it is thrown
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // [m/s] then
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // [m/s²] gravity, or none
  double caught = 0.0;                                     // [s] when the hand should have it

  /// Where it is at a time [s], as if nobody caught it.
  Eigen::Vector3d position(double time) const;
  /// Its velocity then, [m/s].
  Eigen::Vector3d velocity_at(double time) const;
  /// The same flight, faster by a factor: as of another gravity.
  void hasten(double factor);
};

/// Where a ball will be at a time, and how fast: the flight of known acceleration a that fits what was seen of it best, by least
/// squares. With s the time until then, negative before it, p + ½ a s² + v s is fitted to the places seen, for p and v.
class Forecast {
 public:
  /// @param time          [s] that is asked for
  /// @param acceleration  [m/s²] a
  Forecast(double time, const Eigen::Vector3d& acceleration)
      : time_(time), acceleration_(acceleration) {}

  /// A place [m] seen at a time [s].
  void see(double time, const Eigen::Vector3d& place);
  /// Where it will be [m], and its velocity [m/s]: of two places, seen at two times, or more.
  Eigen::Vector3d position() const;
  Eigen::Vector3d velocity() const;  // likewise

 private:
  double time_;
  Eigen::Vector3d acceleration_;
  double n_ = 0.0, s_ = 0.0, ss_ = 0.0;  // sums of 1, s and s²
  Eigen::Vector3d y_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d sy_ =
      Eigen::Vector3d::Zero();  // sums of the places less ½ a s², and of these times s
};

/// By how much a hand misses a ball.
struct Miss {
  double place = 0.0;     // [m] distance at the time when it should be caught
  double velocity = 0.0;  // [m/s] difference then
  double time = 0.0;      // [s] from then to where they are nearest
};

/// From a hand's way in steps of dt, a parabola through three places serving between them. The ball goes on as if nobody caught it.
/// @param way  [m] 3 × N, N ≥ 3, from time 0 on
/// @param dt   [s]
Miss miss(const FlyingBall& ball, const Eigen::Matrix3Xd& way, double dt);

/// The key `ball` of a scene (see scenes/README.md). Each of the camera's pictures, from the first that gives a forecast on,
/// becomes an event of the scene that moves the running primitive's hit to where, and as fast as, the ball is then said to be.
/// @param scene  all of it but the ball has been read
/// @throws Error  names file, line and key
void read_ball(const YamlEntry& entry, Scene& scene);

/// A scene's ball. From when it should be caught on it goes with the hand, if the hand is within its radius then. Outcomes of
/// the arm as it is simulated, see Miss: `miss_m`, `velocity_miss_m_s`, `time_miss_s`.
std::unique_ptr<Object> make_ball(const Scene& scene, const Robot& robot, int ticks, double dt);

}  // namespace seam
