#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "scenes/camera.hpp"
#include "scenes/grains.hpp"
#include <seam/robot_model.hpp>

namespace seam {

/// What a run looks like: what stands in the scene, and where everything was at a fixed frame rate. Pictures and the report
/// page are drawn from it, so that nobody computes kinematics a second time. SI units, in the world; a row per frame.
struct Replay {
  using Track = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Something that moves as one. Poses of its visuals are in the part; a vessel's frame is the part's.
  struct Part {
    std::string name;
    std::vector<Geometry> visuals;
    std::optional<VesselSettings> vessel;
  };
  struct Grains {
    double radius = 0.0;  // [m]
    Track positions;      // N × 3·count [m]
  };
  /// A liquid in a vessel; its surface at rest is `depth` above the vessel's bottom. At radius r and angle θ the surface is
  /// higher by (a cos θ + b sin θ)·J₁(λr/R)/J₁(λ), a and b a row of `waves`, λ = 1.8412 (see liquid.hpp).
  struct Liquid {
    int part = 0;                                 // index of the vessel
    double radius = 0.0, depth = 0.0, rim = 0.0;  // [m]
    Track waves;    // N × 2 [m] height at the wall along the vessel's x and y
    Track spilled;  // N × 1, share of the liquid that has risen above the rim so far [0 to 1]
  };

  std::string scene, method;
  double frame_rate = 60.0;  // [Hz]; frame i is at i/frame_rate, taken at the last tick until then
  std::vector<Part> parts;   // the robot's base and bodies, then what the scene adds
  Track poses;               // N × 7·parts: x y z [m], qx qy qz qw
  std::optional<Grains> grains;
  std::optional<Liquid> liquid;
  Track tool;                           // N × 3 [m] of the tool, or of the robot's last link
  std::vector<int> running;             // N, index of the running primitive, -1 before the first
  std::vector<std::string> primitives;  // names
  std::vector<double> joins;            // [s] also of changes on the way
  Camera camera;

  Eigen::Index frames() const { return poses.rows(); }
  Eigen::Isometry3d pose(Eigen::Index frame, std::size_t part) const;
  void set_pose(Eigen::Index frame, std::size_t part, const Eigen::Isometry3d& X_world_part);

  /// One JSON object (`"format": 1`); tracks are base64 of little-endian float32, row by row. The same run gives the same
  /// bytes.
  /// @throws Error  cannot be written
  void write(const std::string& path) const;
  /// @throws Error  cannot be read, is no replay, or its tracks are not of the size that its parts say
  static Replay read(const std::string& path);
};

}  // namespace seam
