#include "scenes/view/egl_context.hpp"

#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <seam/error.hpp>

namespace seam {

namespace {

constexpr const char* remedy = "(Debian: libegl1 libgl1-mesa-dri libopengl0)";

// epoxy ends the program where it does not find them.
void require_libraries() {
  for (const char* name : {"libEGL.so.1", "libOpenGL.so.0"})
    if (!dlopen(name, RTLD_LAZY))
      throw Error(name, std::string("cannot be loaded, it is needed for pictures ") + remedy);
}

bool is_software(EGLDeviceEXT device) {
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions && std::strstr(extensions, "EGL_MESA_device_software");
}

std::vector<EGLDeviceEXT> devices() {
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
    return {};
  std::array<EGLDeviceEXT, 32> found{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(found.size()), found.data(), &count)) return {};
  return {found.begin(), found.begin() + count};
}

}  // namespace

EglContext::EglContext(const std::string& device) {
  if (device != "auto" && device != "gpu" && device != "software")
    throw Error("device \"" + device + "\"", "must be auto, gpu or software");
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  require_libraries();
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") && open_any(device)) return;
  if (device == "gpu") throw Error("EGL", "no graphics card with OpenGL 3.3 is there");
  throw Error(
      "EGL", std::string("no driver for OpenGL 3.3 is there, it is needed for pictures ") + remedy);
}

bool EglContext::open_any(const std::string& device) {
  for (const bool software : {false, true}) {
    if (device == (software ? "gpu" : "software")) continue;
    for (EGLDeviceEXT each : devices())
      if (is_software(each) == software &&
          open(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, each, nullptr)))
        return true;
  }
  return device != "gpu" && open(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                          EGL_DEFAULT_DISPLAY, nullptr));
}

bool EglContext::open(void* display) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return false;
  display_ = display;
  const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                     EGL_OPENGL_BIT, EGL_NONE};
  const std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  const std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                      3,
                                      EGL_CONTEXT_MINOR_VERSION,
                                      3,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglBindAPI(EGL_OPENGL_API) && eglChooseConfig(display, wanted.data(), &config, 1, &count) &&
      count == 1) {
    surface_ = eglCreatePbufferSurface(display, config, size.data());
    context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
    if (context_ && surface_ && eglMakeCurrent(display, surface_, surface_, context_)) return true;
  }
  eglTerminate(display);
  display_ = surface_ = context_ = nullptr;
  return false;
}

// The display stays open: others in the process may draw on it.
EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglDestroySurface(display_, surface_);
}

std::string EglContext::renderer() const {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

}  // namespace seam
