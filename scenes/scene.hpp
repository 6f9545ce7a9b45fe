#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scenes/ball.hpp"
#include "scenes/camera.hpp"
#include "scenes/event.hpp"
#include "scenes/gates.hpp"
#include "scenes/grains.hpp"
#include "scenes/liquid.hpp"
#include "scenes/obstacles.hpp"
#include <seam/controller.hpp>
#include <seam/obstacles.hpp>
#include <seam/robot_model.hpp>
#include <seam/sequence.hpp>

namespace seam {

/// Ticks that a scene can be played at [s].
inline constexpr double least_tick = 1e-6;
inline constexpr double largest_tick = 0.1;

/// The arm that is all that a controller could wish for: no file tells of it.
inline constexpr const char* ideal_arm = "ideal";

/// What comes of a scene on an arm has a name of its own: `line` on the ideal one, else `line-published`.
std::string on_arm(const std::string& scene, const std::string& arm);

/// Grains that are poured from a bottle in the hand into a glass, which stands at any of several places.
struct Pouring {
  VesselSettings bottle, glass;
  Eigen::Isometry3d X_link_bottle = Eigen::Isometry3d::Identity();
  Eigen::Vector3d glass_at = Eigen::Vector3d::Zero();  // [m] in the world, its bottom
  GrainSettings grains;
  std::vector<Eigen::Vector3d>
      places;  // [m] by which the glass, and with it the goals, are moved; the first is nothing
};

/// A scene file, read and learned: everything that a run needs but the joining method.
struct Scene {
  std::string name;                    // the file's name without its ending
  std::string title;                   // one line
  std::string text;                    // the file as it stands
  std::vector<std::string> overrides;  // with which it was read
  std::string urdf;                    // path of the robot's
  std::string arm = ideal_arm;         // how it differs from an ideal one: name of its file
  RobotModel robot;                    // as the controller takes it to be
  RobotModel simulated;  // as Bullet has it: with the joints of a liquid behind the others
  RobotSettings::Encoders encoders = RobotSettings::Encoders::motor;
  std::optional<LiquidSettings> liquid;                            // that moves
  Eigen::Isometry3d X_link_glass = Eigen::Isometry3d::Identity();  // of its glass, in the tool's
  std::optional<Pouring> pouring;
  std::vector<Gate> gates;
  std::vector<SolidObstacle> obstacles;
  std::optional<FlyingBall> ball;
  Eigen::VectorXd start;             // [rad] joint positions at rest
  std::optional<ToolSettings> tool;  // in task space
  Sequence sequence;
  std::vector<std::string> primitive_names;  // one per step of the sequence
  std::vector<ObstacleSettings> couplings;   // what the sequence keeps away from
  ControlSettings control;
  ActuatorSettings actuator;
  SensorSettings sensor;
  GuardSettings guard;
  std::optional<Join> method;  // with which `seam run` plays it unless told otherwise
  double dt = 1e-3;            // [s] Bullet's tick
  double duration = 0.0;       // [s] of a run
  double speed = 1.0;          // factor by which all of it is faster than its file's times say
  int seed = 0;                // of whatever is drawn by chance
  std::vector<Event> events;
  std::optional<Camera> camera;   // else one that all fits into
  std::optional<Geometry> table;  // a box in the world that is seen, no more
  std::string figure;             // the joint, or the tool's coordinate, that the figure shows

  int ticks(double step) const;  // of a run
  std::size_t places() const { return pouring ? pouring->places.size() : 1; }
  /// The sequence for a place of the glass: all goals are moved, the weights are those learned.
  Sequence sequence_at(std::size_t place) const;
  ControllerSettings controller() const;
  /// What the sequence moves: the tool; in joint space the last link.
  Frame tool_frame() const;

  /// Reads a scene file (the format is explained in scenes/README.md), in which some entries are set anew: see
  /// YamlEntry::read. It may name files in its own folder and below, in seam's own scenes and assets, and in those of
  /// further folders that are allowed.
  /// @throws Error  names file, line and key
  static Scene read(const std::string& path, const std::vector<std::string>& overrides = {},
                    const std::vector<std::string>& allowed = {});
};

}  // namespace seam
