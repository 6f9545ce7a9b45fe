#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "scenes/grains.hpp"
#include "scenes/replay.hpp"
#include <seam/mesh.hpp>

namespace seam {

/// A curve (r, z) turned about the z axis. Its corners are sharp; its outside is at the right of its direction.
Mesh revolved(const std::vector<Eigen::Vector2f>& profile);
/// A surface over a grid of rows × columns points, anticlockwise from outside: point(row, column).
Mesh surface(int rows, int columns, const std::function<Eigen::Vector3f(int, int)>& point);

Mesh box(const Eigen::Vector3d& edges);
Mesh cylinder(double radius, double length);
Mesh sphere(double radius);
/// A round tube along a path of at least two points.
Mesh tube(const std::vector<Eigen::Vector3f>& path, double radius);
/// A vessel with its wall and floor.
Mesh vessel(const VesselSettings& settings);
/// A liquid with its wave's heights at the wall along x and y [m].
Mesh liquid(const Replay::Liquid& settings, const Eigen::Vector2d& wave);

}  // namespace seam
