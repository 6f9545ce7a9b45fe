#include "scenes/view/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <epoxy/gl.h>

#include "scenes/view/shaders.hpp"
#include "scenes/view/shapes.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr std::array<int, 2> map_size{1024, 256};  // the coarser, the softer
constexpr int most_samples = 4;
constexpr double height_of_view = 35.0 * M_PI / 180.0;
const Eigen::Vector3f to_light = Eigen::Vector3f(0.35F, -0.55F, 1.0F).normalized();

float linear(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

Eigen::Vector4f linear(const Eigen::Vector3f& srgb, float opacity) {
  return {linear(srgb.x()), linear(srgb.y()), linear(srgb.z()), opacity};
}

Eigen::Matrix4d look(const Eigen::Vector3d& from, const Eigen::Vector3d& at,
                     const Eigen::Vector3d& up) {
  const Eigen::Vector3d back = (from - at).normalized();
  const Eigen::Vector3d right = up.cross(back).normalized();
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.row(0).head<3>() = right;
  view.row(1).head<3>() = back.cross(right);
  view.row(2).head<3>() = back;
  view.col(3).head<3>() = -view.topLeftCorner<3, 3>() * from;
  return view;
}

Eigen::Matrix4d perspective(double tangent, double aspect, double near, double far) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  matrix(0, 0) = 1.0 / (aspect * tangent);
  matrix(1, 1) = 1.0 / tangent;
  matrix(2, 2) = (near + far) / (near - far);
  matrix(2, 3) = 2.0 * near * far / (near - far);
  matrix(3, 2) = -1.0;
  return matrix;
}

// What a light far away sees of a ball.
Eigen::Matrix4f light_view(const Eigen::Vector3f& direction, const Eigen::Vector3d& centre,
                           double radius) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.diagonal() << 1.0 / radius, 1.0 / radius, -1.0 / radius, 1.0;
  return (matrix * look(centre + 1e-3 * direction.cast<double>(), centre, {0.0, 1.0, 0.1}))
      .cast<float>();
}

GLuint compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::array<char, 1000> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error("OpenGL", std::string("the driver does not take a shader: ") + log.data());
}

class Program {
 public:
  explicit Program(const char* fragment) : name_(glCreateProgram()) {
    for (const GLuint shader :
         {compile(GL_VERTEX_SHADER, vertex_shader), compile(GL_FRAGMENT_SHADER, fragment)}) {
      glAttachShader(name_, shader);
      glDeleteShader(shader);
    }
    glLinkProgram(name_);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() { glDeleteProgram(name_); }

  void use() const { glUseProgram(name_); }
  void set(const char* uniform, int value) const { glUniform1i(place(uniform), value); }
  void set(const char* uniform, float value) const { glUniform1f(place(uniform), value); }
  void set(const char* uniform, const Eigen::Vector2f& v) const {
    glUniform2fv(place(uniform), 1, v.data());
  }
  void set(const char* uniform, const Eigen::Vector3f& v) const {
    glUniform3fv(place(uniform), 1, v.data());
  }
  void set(const char* uniform, const Eigen::Vector4f& v) const {
    glUniform4fv(place(uniform), 1, v.data());
  }
  void set(const char* uniform, const Eigen::Matrix3f& m) const {
    glUniformMatrix3fv(place(uniform), 1, GL_FALSE, m.data());
  }
  void set(const char* uniform, const Eigen::Matrix4f& m) const {
    glUniformMatrix4fv(place(uniform), 1, GL_FALSE, m.data());
  }

 private:
  GLint place(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

  GLuint name_;
};

// A framebuffer with what it draws into: renderbuffers, or a depth texture for shadows.
struct Target {
  GLuint frame = 0;
  std::array<GLuint, 2> buffers{};
  GLuint texture = 0;

  ~Target() {
    glDeleteFramebuffers(1, &frame);
    glDeleteRenderbuffers(2, buffers.data());
    glDeleteTextures(1, &texture);
  }
};

void require_complete(int width, int height) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE &&
      glGetError() == GL_NO_ERROR)
    return;
  throw Error("picture of " + std::to_string(width) + "x" + std::to_string(height),
              "is beyond the OpenGL driver");
}

void make_picture(Target& target, int width, int height, int samples) {
  glGenFramebuffers(1, &target.frame);
  glBindFramebuffer(GL_FRAMEBUFFER, target.frame);
  glGenRenderbuffers(2, target.buffers.data());
  const std::array<GLenum, 2> formats{GL_SRGB8_ALPHA8, GL_DEPTH_COMPONENT24};
  const std::array<GLenum, 2> places{GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
  for (std::size_t i = 0; i < 2; ++i) {
    glBindRenderbuffer(GL_RENDERBUFFER, target.buffers[i]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, formats[i], width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, target.buffers[i]);
  }
  require_complete(width, height);
}

void make_shadow_map(Target& target, int size) {
  glGenTextures(1, &target.texture);
  glBindTexture(GL_TEXTURE_2D, target.texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glGenFramebuffers(1, &target.frame);
  glBindFramebuffer(GL_FRAMEBUFFER, target.frame);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, target.texture, 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  require_complete(size, size);
}

int samples() {
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  return std::clamp(most, 0, most_samples);
}

Item floor_of(const Eigen::Vector3d& centre, double radius) {
  const Mesh square = surface(2, 2, [&](int row, int column) {
    return Eigen::Vector3d(centre.x() + radius * (2 * column - 1),
                           centre.y() + radius * (2 * row - 1), 0.0)
        .cast<float>()
        .eval();
  });
  Item floor;
  floor.mesh = std::make_shared<GpuMesh>(square);
  floor.finish = Item::Finish::floor;
  floor.colour.setConstant(0.985F);
  floor.shadow = false;
  return floor;
}

void place(const Item& item, const Program& program) {
  program.set("X_world_mesh", item.X_world_mesh);
  const Eigen::Matrix3f linear_part = item.X_world_mesh.topLeftCorner<3, 3>();
  program.set("turn", Eigen::Matrix3f(linear_part.inverse().transpose()));
}

void draw_surface(const Item& item, const Program& program) {
  place(item, program);
  program.set("finish", static_cast<int>(item.finish));
  program.set("colour", linear(item.colour, 1.0F));
  program.set("above", linear(item.above, item.limit > 0.0F ? 1.0F : 0.0F));
  program.set("limit", item.limit);
  item.mesh->draw();
}

Eigen::Vector3f background_colour() {
  const auto& [r, g, b] = Renderer::background;
  return linear(Eigen::Vector3f(r, g, b) / 255.0F, 1.0F).head<3>();
}

}  // namespace

Lens::Lens(const Camera& camera, int width, int height) : width_(width), height_(height) {
  const double aspect = static_cast<double>(width) / height;
  const double tangent = std::tan(0.5 * height_of_view) * std::max(1.0, 4.0 / 3.0 / aspect);
  const double distance = (camera.from - camera.at).norm();
  matrix_ = perspective(tangent, aspect, 0.02 * distance, 20.0 * distance) *
            look(camera.from, camera.at, Eigen::Vector3d::UnitZ());
}

Eigen::Vector3d Lens::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector4d clip = matrix_ * point.homogeneous();
  const Eigen::Vector2d at = clip.head<2>() / clip.w();
  return {0.5 * (1.0 + at.x()) * width_, 0.5 * (1.0 - at.y()) * height_, clip.w()};
}

struct Renderer::Parts {
  int width, height;
  Target picture, flat;
  std::array<Target, 2> shadows;
  Program depth, surfaces;

  void cast_shadows(const std::vector<Item>& items, const Eigen::Matrix4f* views) const;
  Image read() const;
};

Renderer::Renderer(int width, int height)
    : parts_(new Parts{width, height, {}, {}, {}, Program(depth_shader), Program(surface_shader)}) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  if (std::max(width, height) > most) require_complete(width, height);
  make_picture(parts_->picture, width, height, samples());
  make_picture(parts_->flat, width, height, 0);
  for (std::size_t i = 0; i < map_size.size(); ++i)
    make_shadow_map(parts_->shadows[i], map_size[i]);
}

Renderer::~Renderer() = default;

void Renderer::Parts::cast_shadows(const std::vector<Item>& items,
                                   const Eigen::Matrix4f* views) const {
  depth.use();
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5F, 4.0F);
  for (std::size_t i = 0; i < shadows.size(); ++i) {
    glBindFramebuffer(GL_FRAMEBUFFER, shadows[i].frame);
    glViewport(0, 0, map_size[i], map_size[i]);
    glClear(GL_DEPTH_BUFFER_BIT);
    depth.set("view", views[i]);
    for (const Item& item : items) {
      if (!item.shadow) continue;
      place(item, depth);
      item.mesh->draw();
    }
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

Image Renderer::Parts::read() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.frame);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, flat.frame);
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, flat.frame);
  Image upside_down(width, height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.rgb.data());
  Image image(width, height);
  const std::ptrdiff_t row = 3L * width;
  for (int y = 0; y < height; ++y)
    std::copy_n(upside_down.rgb.begin() + row * (height - 1 - y), row, image.rgb.begin() + row * y);
  return image;
}

Image Renderer::draw(const std::vector<Item>& given, const Camera& camera,
                     const Eigen::AlignedBox3d& around) const {
  const double radius = 0.5 * around.diagonal().norm();
  std::vector<Item> items = given;
  const double floor_radius = 3.0 * radius;
  items.push_back(floor_of(around.center(), floor_radius));
  const std::array<Eigen::Matrix4f, 2> views{
      light_view(to_light, around.center(), radius),
      light_view(Eigen::Vector3f::UnitZ(), around.center(), radius)};
  parts_->cast_shadows(items, views.data());

  const Program& program = parts_->surfaces;
  program.use();
  glBindFramebuffer(GL_FRAMEBUFFER, parts_->picture.frame);
  glViewport(0, 0, parts_->width, parts_->height);
  glEnable(GL_FRAMEBUFFER_SRGB);
  const Eigen::Vector3f back = background_colour();
  glClearColor(back.x(), back.y(), back.z(), 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  program.set("view", Lens(camera, parts_->width, parts_->height).matrix().cast<float>().eval());
  program.set("eye", camera.from.cast<float>().eval());
  program.set("to_light", to_light);
  program.set("background", back);
  program.set("metres", static_cast<float>(2.0 * radius));
  program.set("floor_at", around.center().head<2>().cast<float>().eval());
  program.set("floor_radius", static_cast<float>(floor_radius));
  for (const int i : {0, 1}) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    glBindTexture(GL_TEXTURE_2D, parts_->shadows[static_cast<std::size_t>(i)].texture);
    program.set(i == 0 ? "shadow[0]" : "shadow[1]", i);
    program.set(i == 0 ? "shadow_view[0]" : "shadow_view[1]", views[static_cast<std::size_t>(i)]);
  }
  for (const Item& item : items)
    if (item.finish != Item::Finish::glass) draw_surface(item, program);

  // Glass lets through what is behind it: its far walls first.
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
    glCullFace(hidden);
    for (const Item& item : items)
      if (item.finish == Item::Finish::glass) draw_surface(item, program);
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  const Image image = parts_->read();
  glDisable(GL_FRAMEBUFFER_SRGB);
  return image;
}

}  // namespace seam
