#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "bench/body_figures.hpp"
#include <seam/robot_model.hpp>

namespace seam {

struct CheckSettings {
  int samples = 1000;  // random states within the limits
  int seed = 1;        // of them
};

enum class Verdict { ok, warning, failed };

/// One thing that was looked at: what it came to, and one line for each oddity.
struct Check {
  std::string name;
  Verdict verdict = Verdict::ok;
  std::string figure;
  std::vector<std::string> oddities;
};

/// A robot in figures. Failed are a mesh that is not there or cannot be read, and accelerations that Bullet does not make
/// as asked to 1e-7 of the largest; everything else that looks wrong is a warning.
struct RobotCheck {
  std::vector<BodyFigures> bodies;  // one per joint
  MeshCatalogue meshes;             // of all shapes
  double acceleration_error =
      0.0;  // [rad/s² or m/s²] forward against inverse dynamics in Bullet, on a tilted base
  double largest_acceleration = 0.0;  // [rad/s² or m/s²] asked for
  Eigen::VectorXd
      holding;  // [N·m or N] largest torque that holds each joint against gravity, base upright
  std::string tip;              // the last link of the longest chain
  double reach = 0.0;           // [m] largest distance of its origin from the root link's
  double mean_reach = 0.0;      // [m]
  Eigen::AlignedBox3d reached;  // [m] where it came, in the root link's frame
  std::vector<Check> checks;    // URDF, limits, inertia, meshes, dynamics, holding, reach

  Verdict verdict() const;  // the worst
};

/// Looks a robot over. The same settings give the same figures.
RobotCheck check_robot(const RobotModel& robot, const CheckSettings& settings = {});

}  // namespace seam
