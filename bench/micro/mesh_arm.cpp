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

// A ball of radius 1 of 17 circles of 20 vertices and two poles.
std::string ball_as_obj() {
  constexpr int circles = 17, around = 20;
  std::ostringstream obj;
  obj << "v 0 0 1\nv 0 0 -1\n";
  for (int i = 1; i <= circles; ++i)
    for (int k = 0; k < around; ++k) {
      const double polar = M_PI * i / (circles + 1), azimuth = 2.0 * M_PI * k / around;
      obj << "v " << std::sin(polar) * std::cos(azimuth) << ' '
          << std::sin(polar) * std::sin(azimuth) << ' ' << std::cos(polar) << '\n';
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

// Into the box around what the body collides as.
Geometry ellipsoid_for(const Body& body, const std::string& ball) {
  Eigen::AlignedBox3d box;
  for (const Geometry& shape : body.collisions) {
    const Eigen::Vector3d half = half_size(shape);
    box.extend(Eigen::AlignedBox3d(-half, half).transformed(shape.X_body_shape));
  }
  Geometry ellipsoid;
  ellipsoid.type = Geometry::Type::mesh;
  ellipsoid.mesh = ball;
  ellipsoid.scale = 0.5 * box.sizes();
  ellipsoid.X_body_shape.translation() = box.center();
  return ellipsoid;
}

RobotModel made(const std::string& ball) {
  write_whole(ball, ball_as_obj());
  RobotModel model = pa10();
  model.base.collisions = {ellipsoid_for(model.base, ball)};
  for (Body& body : model.bodies) body.collisions = {ellipsoid_for(body, ball)};
  return model;
}

}  // namespace

const RobotModel& mesh_arm() {
  static const Folder folder;
  static const RobotModel model = made(folder.file("ball.obj"));
  return model;
}

}  // namespace seam::micro
