#include "bench/body_figures.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <seam/error.hpp>
#include <seam/mesh.hpp>

namespace seam {

namespace {

// Below this share of its box a mesh is taken for open, or for a mere surface.
constexpr double least_filled = 0.01;

MeshFigures read_mesh(const std::string& path) {
  MeshFigures figures;
  for (const Mesh& mesh : load_mesh(path)) {
    const Eigen::Matrix3Xd points = mesh.positions.cast<double>();
    for (const auto& point : points.colwise()) figures.box.extend(Eigen::Vector3d(point));
    figures.triangles += static_cast<int>(mesh.triangles.cols());
    for (const auto& corner : mesh.triangles.colwise())
      figures.volume +=
          points.col(corner(0)).dot(points.col(corner(1)).cross(points.col(corner(2)))) / 6.0;
  }
  const double most = figures.box.volume();
  figures.volume = std::abs(figures.volume);
  if (!(figures.volume > least_filled * most && figures.volume <= most)) figures.volume = most;
  return figures;
}

Eigen::AlignedBox3d around_origin(const Eigen::Vector3d& half) {
  return {-half, half};
}

struct Extent {
  Eigen::AlignedBox3d box;  // in the shape's frame
  double volume;
};

Extent extent_of(const Geometry& shape, MeshCatalogue& meshes) {
  const Eigen::Vector3d& size = shape.size;
  switch (shape.type) {
    case Geometry::Type::box:
      return {around_origin(size / 2.0), size.prod()};
    case Geometry::Type::cylinder:
      return {around_origin({size.x(), size.x(), size.z() / 2.0}),
              M_PI * size.x() * size.x() * size.z()};
    case Geometry::Type::capsule:
      return {around_origin({size.x(), size.x(), size.z() / 2.0 + size.x()}),
              M_PI * size.x() * size.x() * (size.z() + 4.0 / 3.0 * size.x())};
    case Geometry::Type::sphere:
      return {around_origin(Eigen::Vector3d::Constant(size.x())),
              4.0 / 3.0 * M_PI * std::pow(size.x(), 3)};
    default: {
      const MeshFigures& mesh = meshes[shape.mesh];
      if (mesh.box.isEmpty()) return {{}, 0.0};
      const Eigen::Vector3d a = mesh.box.min().cwiseProduct(shape.scale);
      const Eigen::Vector3d b = mesh.box.max().cwiseProduct(shape.scale);
      return {{a.cwiseMin(b), a.cwiseMax(b)}, mesh.volume * std::abs(shape.scale.prod())};
    }
  }
}

double farthest_corner(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from) {
  return box.isEmpty()
             ? 0.0
             : (box.max() - from).cwiseAbs().cwiseMax((box.min() - from).cwiseAbs()).norm();
}

}  // namespace

const MeshFigures& MeshCatalogue::operator[](const std::string& path) {
  const auto [entry, is_new] = files_.try_emplace(path);
  if (is_new) try {
      entry->second = read_mesh(path);
    } catch (const Error& error) {
      entry->second.unreadable = error.what();
    }
  return entry->second;
}

BodyFigures body_figures(const Body& body, MeshCatalogue& meshes) {
  BodyFigures figures;
  const double mass = body.inertial.mass;
  figures.moments = body.inertial.inertia.selfadjointView<Eigen::Lower>().eigenvalues();
  figures.gyration = mass > 0.0 ? (figures.moments / mass).cwiseMax(0.0).cwiseSqrt().eval()
                                : Eigen::Vector3d::Zero().eval();
  double volume = 0.0;
  for (const auto* shapes : {&body.visuals, &body.collisions}) {
    double together = 0.0;
    for (const Geometry& shape : *shapes) {
      const Extent extent = extent_of(shape, meshes);
      if (extent.box.isEmpty()) continue;
      figures.box.extend(extent.box.transformed(shape.X_body_shape));
      together += extent.volume;
    }
    volume = std::max(volume, together);
  }
  figures.reach = farthest_corner(figures.box, body.inertial.com);
  if (volume > 0.0) figures.density = mass / volume;
  return figures;
}

}  // namespace seam
