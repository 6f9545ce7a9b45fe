#pragma once

#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "scenes/camera.hpp"
#include "scenes/view/gpu_mesh.hpp"
#include "scenes/view/image.hpp"

namespace seam {

/// Something that is seen.
struct Item {
  enum class Finish { painted, metal, glass, floor, shining };

  std::shared_ptr<const GpuMesh> mesh;
  Eigen::Matrix4f X_world_mesh = Eigen::Matrix4f::Identity();  // may scale
  Eigen::Vector3f colour = Eigen::Vector3f::Ones();            // sRGB 0…1
  Finish finish = Finish::painted;
  bool shadow = true;
  float limit =
      0.0F;  // [m] what is higher in the mesh's frame has another colour, if it is above 0
  Eigen::Vector3f above = Eigen::Vector3f::Zero();
};

/// From the world to the picture: x and y in pixels from the top left, z the distance along the view [m].
class Lens {
 public:
  /// The view is 35° high, in pictures narrower than 4:3 as wide as in those.
  Lens(const Camera& camera, int width, int height);
  Eigen::Vector3d project(const Eigen::Vector3d& point) const;
  const Eigen::Matrix4d& matrix() const noexcept { return matrix_; }

 private:
  Eigen::Matrix4d matrix_;  // to OpenGL's clip space
  int width_, height_;
};

/// Draws pictures of one size: a light from above with soft shadows, an open sky, a floor with a grid of 0.1 and 0.5 m that
/// fades into the background. Needs a current context from first to last.
class Renderer {
 public:
  /// @throws Error  a picture of this size is beyond the driver
  Renderer(int width, int height);
  ~Renderer();

  /// @param around  what shadows and floor reach to
  Image draw(const std::vector<Item>& items, const Camera& camera,
             const Eigen::AlignedBox3d& around) const;

  static constexpr Image::Colour background{247, 248, 250};

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seam
