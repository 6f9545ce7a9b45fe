#pragma once

#include <string>

namespace seam {

/// OpenGL 3.3 core without a display, current in the thread that made it while it lives.
class EglContext {
 public:
  /// @param device  `auto`: a graphics card's if there is one that works, else the processor's; `gpu` or `software`: no
  ///                other than that
  /// @throws Error  there is none (says what to install), or another name
  explicit EglContext(const std::string& device = "auto");
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext();

  /// What draws, as the driver calls itself.
  std::string renderer() const;

 private:
  bool open_any(const std::string& device);
  bool open(void* display);

  void* display_ = nullptr;
  void* surface_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace seam
