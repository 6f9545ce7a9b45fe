#include "scenes/view/shapes.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace seam {

namespace {

constexpr int around = 64;
constexpr double lambda = 1.8411837813406593;

Eigen::Vector3f turned(const Eigen::Vector2f& rz, int step) {
  const double angle = 2.0 * M_PI * step / around;
  return {rz.x() * static_cast<float>(std::cos(angle)),
          rz.x() * static_cast<float>(std::sin(angle)), rz.y()};
}

Mesh joined(const std::vector<Mesh>& parts) {
  Eigen::Index vertices = 0;
  Eigen::Index triangles = 0;
  for (const Mesh& part : parts) {
    vertices += part.positions.cols();
    triangles += part.triangles.cols();
  }
  Mesh all{Eigen::Matrix3Xf(3, vertices), Eigen::Matrix3Xf(3, vertices),
           Eigen::Matrix3Xi(3, triangles)};
  vertices = triangles = 0;
  for (const Mesh& part : parts) {
    all.positions.middleCols(vertices, part.positions.cols()) = part.positions;
    all.normals.middleCols(vertices, part.normals.cols()) = part.normals;
    all.triangles.middleCols(triangles, part.triangles.cols()) =
        part.triangles.array() + static_cast<int>(vertices);
    vertices += part.positions.cols();
    triangles += part.triangles.cols();
  }
  return all;
}

// Height of the surface of a wave, in proportion to that at the wall (see liquid.hpp).
double first_mode(double share_of_radius) {
  return std::cyl_bessel_j(1.0, lambda * share_of_radius) / std::cyl_bessel_j(1.0, lambda);
}

}  // namespace

Mesh surface(int rows, int columns, const std::function<Eigen::Vector3f(int, int)>& point) {
  const auto index = [&](int row, int column) { return row * columns + column; };
  Mesh mesh{Eigen::Matrix3Xf(3, rows * columns), Eigen::Matrix3Xf::Zero(3, rows * columns),
            Eigen::Matrix3Xi(3, 2 * (rows - 1) * (columns - 1))};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      mesh.positions.col(index(row, column)) = point(row, column);
  int next = 0;
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      const int a = index(row, column);
      const int b = index(row, column + 1);
      const int c = index(row + 1, column + 1);
      const int d = index(row + 1, column);
      mesh.triangles.col(next++) << a, b, c;
      mesh.triangles.col(next++) << a, c, d;
    }
  for (const auto& corners : mesh.triangles.colwise()) {
    const Eigen::Vector3f p = mesh.positions.col(corners(0));
    const Eigen::Vector3f area = (mesh.positions.col(corners(1)) - p)
                                     .cross(Eigen::Vector3f(mesh.positions.col(corners(2)) - p));
    for (const int corner : corners) mesh.normals.col(corner) += area;
  }
  // A seam, where the last column meets the first, is smooth.
  for (int row = 0; row < rows; ++row) {
    const int first = index(row, 0);
    const int last = index(row, columns - 1);
    if ((mesh.positions.col(first) - mesh.positions.col(last)).norm() > 1e-6F) continue;
    const Eigen::Vector3f sum = mesh.normals.col(first) + mesh.normals.col(last);
    mesh.normals.col(first) = mesh.normals.col(last) = sum;
  }
  mesh.normals.colwise().normalize();
  return mesh;
}

Mesh revolved(const std::vector<Eigen::Vector2f>& profile) {
  std::vector<Mesh> bands;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    bands.push_back(surface(2, around + 1, [&](int row, int column) {
      return turned(profile[i + static_cast<std::size_t>(row)], column);
    }));
  return joined(bands);
}

Mesh box(const Eigen::Vector3d& edges) {
  const Eigen::Vector3f half = 0.5F * edges.cast<float>();
  std::vector<Mesh> sides;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0F, 1.0F})
      sides.push_back(surface(2, 2, [&](int row, int column) {
        Eigen::Vector3f p;
        p(axis) = side;
        p((axis + 1) % 3) = 2.0F * static_cast<float>(column) - 1.0F;
        p((axis + 2) % 3) = side * (2.0F * static_cast<float>(row) - 1.0F);
        return p.cwiseProduct(half).eval();
      }));
  return joined(sides);
}

Mesh cylinder(double radius, double length) {
  const auto r = static_cast<float>(radius);
  const auto z = static_cast<float>(0.5 * length);
  return revolved({{0.0F, -z}, {r, -z}, {r, z}, {0.0F, z}});
}

Mesh sphere(double radius) {
  constexpr int rows = 24;
  Mesh mesh = surface(rows + 1, around + 1, [&](int row, int column) {
    const double polar = M_PI * row / rows;
    const Eigen::Vector2d rz(radius * std::sin(polar), -radius * std::cos(polar));
    return turned(rz.cast<float>(), column);
  });
  mesh.normals = mesh.positions.colwise().normalized();
  return mesh;
}

Mesh tube(const std::vector<Eigen::Vector3f>& path, double radius) {
  constexpr int sides = 10;
  const auto count = static_cast<int>(path.size());
  const auto at = [&](int i) {
    return path[static_cast<std::size_t>(std::clamp(i, 0, count - 1))];
  };
  Eigen::Vector3f along = Eigen::Vector3f::UnitX();
  std::vector<Eigen::Matrix<float, 3, 2>> across;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f step = at(i + 1) - at(i - 1);
    if (step.norm() > 1e-9F) along = step.normalized();
    Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
    if (std::abs(along.z()) > 0.9F) up = Eigen::Vector3f::UnitX();
    if (!across.empty()) up = across.back().col(1);
    const Eigen::Vector3f side = up.cross(along).normalized();
    across.emplace_back();
    across.back() << side, along.cross(side);
  }
  return surface(count, sides + 1, [&](int row, int column) -> Eigen::Vector3f {
    const double angle = 2.0 * M_PI * column / sides;
    const Eigen::Vector2f out(static_cast<float>(radius * std::cos(angle)),
                              static_cast<float>(radius * std::sin(angle)));
    return at(row) + across[static_cast<std::size_t>(row)] * out;
  });
}

Mesh vessel(const VesselSettings& settings) {
  const auto inside = static_cast<float>(settings.radius);
  const auto outside = static_cast<float>(settings.radius + settings.wall);
  const auto top = static_cast<float>(settings.height);
  const auto bottom = static_cast<float>(-settings.wall);
  return revolved({{0.0F, bottom},
                   {outside, bottom},
                   {outside, top},
                   {inside, top},
                   {inside, 0.0F},
                   {0.0F, 0.0F}});
}

Mesh liquid(const Replay::Liquid& settings, const Eigen::Vector2d& wave) {
  constexpr int rings = 16;
  const double R = 0.995 * settings.radius;
  const auto point = [&](double share, int column) {
    const double angle = 2.0 * M_PI * column / around;
    const double height = wave.x() * std::cos(angle) + wave.y() * std::sin(angle);
    const double z = std::max(0.001, settings.depth + height * first_mode(share));
    return Eigen::Vector3d(share * R * std::cos(angle), share * R * std::sin(angle), z);
  };
  const Mesh side = surface(2, around + 1, [&](int row, int column) {
    Eigen::Vector3d p = point(1.0, column);
    if (row == 0) p.z() = 0.001;
    return p.cast<float>().eval();
  });
  const Mesh top = surface(rings + 1, around + 1, [&](int row, int column) {
    return point(1.0 - static_cast<double>(row) / rings, column).cast<float>().eval();
  });
  return joined({side, top});
}

}  // namespace seam
