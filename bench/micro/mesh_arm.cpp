#include "bench/micro/mesh_arm.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "bench/micro/arms.hpp"
#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam::micro {

namespace {

constexpr double slimness = 0.8;

/// A folder that is removed at the end.
class Folder {
 public:
  Folder() {
    if (!mkdtemp(path_.data())) throw Error(path_, "cannot be made");
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_ = std::filesystem::temp_directory_path() / "seam_micro-XXXXXX";
};

// A cylinder of radius 1 and height 2 with rounded edges: 14 circles of 24 vertices, and the centres of both ends.
std::string cylinder_as_obj() {
  constexpr int circles = 14, around = 24;
  constexpr double rounding = 0.3;
  std::ostringstream obj;
  obj << "v 0 0 1\nv 0 0 -1\n";
  for (int i = 0; i < circles; ++i) {
    const double side = i < circles / 2 ? 1.0 : -1.0;
    const double from_end = i < circles / 2 ? i : circles - 1 - i;
    const double slope = 0.5 * M_PI * from_end / (circles / 2 - 1);
    const double radius = 1.0 - rounding + rounding * std::sin(slope);
    const double height = side * (1.0 - rounding + rounding * std::cos(slope));
    for (int k = 0; k < around; ++k) {
      const double azimuth = 2.0 * M_PI * k / around;
      obj << "v " << radius * std::cos(azimuth) << ' ' << radius * std::sin(azimuth) << ' '
          << height << '\n';
    }
  }
  const auto at = [](int circle, int k) { return 3 + circle * around + k % around; };
  for (int k = 0; k < around; ++k) {
    obj << "f 1 " << at(0, k) << ' ' << at(0, k + 1) << '\n';
    obj << "f 2 " << at(circles - 1, k + 1) << ' ' << at(circles - 1, k) << '\n';
    for (int i = 0; i + 1 < circles; ++i)
      obj << "f " << at(i, k) << ' ' << at(i + 1, k) << ' ' << at(i + 1, k + 1) << ' '
          << at(i, k + 1) << '\n';
  }
  return obj.str();
}

Eigen::Vector3d half_size(const Geometry& shape) {
  const Eigen::Vector3d& size = shape.size;
  if (shape.type == Geometry::Type::cylinder) return {size.x(), size.x(), 0.5 * size.z()};
  return 0.5 * size;
}

// Into the box around what the body collides as, and slimmer, so that it meets no other in the movement.
Geometry cylinder_for(const Body& body, const std::string& mesh) {
  Eigen::AlignedBox3d box;
  for (const Geometry& shape : body.collisions) {
    const Eigen::Vector3d half = half_size(shape);
    box.extend(Eigen::AlignedBox3d(-half, half).transformed(shape.X_body_shape));
  }
  Geometry cylinder;
  cylinder.type = Geometry::Type::mesh;
  cylinder.mesh = mesh;
  cylinder.scale = slimness * 0.5 * box.sizes();
  cylinder.X_body_shape.translation() = box.center();
  return cylinder;
}

RobotModel made(const std::string& mesh) {
  write_whole(mesh, cylinder_as_obj());
  RobotModel model = pa10();
  model.base.collisions = {cylinder_for(model.base, mesh)};
  for (Body& body : model.bodies) body.collisions = {cylinder_for(body, mesh)};
  return model;
}

}  // namespace

const RobotModel& mesh_arm() {
  static const Folder folder;
  static const RobotModel model = made(folder.file("cylinder.obj"));
  return model;
}

}  // namespace seam::micro
