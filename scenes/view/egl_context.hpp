#pragma once

#include <string>
#include <vector>

namespace seam {

/// What EGL could draw with.
struct EglDevice {
  void* handle = nullptr;  // EGLDeviceEXT
  bool software = false;   // draws on the processor (Mesa's llvmpipe)
};

/// The devices of all drivers that are installed, in EGL's order; none where EGL cannot list them.
/// @throws Error  there is no EGL (says what to install)
std::vector<EglDevice> egl_devices();

/// OpenGL 3.3 core without a display, current in the thread that made it while it lives.
class EglContext {
 public:
  /// @param device  `auto`: a graphics card if there is one that works, else llvmpipe, which draws on the processor; `gpu`
  ///                or `software`: that one and no other
  /// @throws Error  there is none (says what to install), or another name
  explicit EglContext(const std::string& device = "auto");
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext();

  /// What draws, as the driver calls itself.
  std::string renderer() const;

 private:
  bool open(const EglDevice& device);
  bool make_current();
  void close();

  void* display_ = nullptr;
  void* surface_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace seam
