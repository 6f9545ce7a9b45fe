#include "scenes/view/egl_context.hpp"

#include <array>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <seam/error.hpp>

namespace seam {

namespace {

constexpr const char* remedy = "(Debian: libegl1 libegl-mesa0 libgl1-mesa-dri libopengl0)";

// epoxy ends the program where it does not find them.
void require_libraries() {
  for (const char* name : {"libEGL.so.1", "libOpenGL.so.0"})
    if (!dlopen(name, RTLD_LAZY))
      throw Error(name, std::string("cannot be loaded, it is needed for pictures ") + remedy);
}

bool offers(const char* extension) {
  return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension);
}

// One extension of old, or the two that it was split into: a driver may name either.
bool lists_devices() {
  return offers("EGL_EXT_device_base") ||
         (offers("EGL_EXT_device_enumeration") && offers("EGL_EXT_device_query"));
}

bool is_software(EGLDeviceEXT device) {
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions && std::strstr(extensions, "EGL_MESA_device_software");
}

// Mesa draws on the processor where it has no driver for a card.
bool draws_as(const std::string& renderer, bool software) {
  const auto is = [&](const char* name) { return renderer.find(name) != std::string::npos; };
  return software ? is("llvmpipe") : !is("llvmpipe") && !is("softpipe") && !is("swrast");
}

[[noreturn]] void refuse(const std::string& device) {
  if (device == "gpu")
    throw Error("EGL",
                "no graphics card with OpenGL 3.3 can be used: its driver must be installed, and "
                "you must be allowed to open /dev/dri/render* or /dev/nvidia*");
  const char* lack =
      device == "software"
          ? "llvmpipe is not there, it is needed for pictures without a graphics card "
          : "no driver for OpenGL 3.3 is there, it is needed for pictures ";
  throw Error("EGL", std::string(lack) + remedy);
}

}  // namespace

std::vector<EglDevice> egl_devices() {
  require_libraries();
  if (!offers("EGL_EXT_platform_base") || !lists_devices()) return {};
  std::array<EGLDeviceEXT, 32> found{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(found.size()), found.data(), &count)) return {};
  std::vector<EglDevice> devices;
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = found[static_cast<std::size_t>(i)];
    devices.push_back({device, is_software(device)});
  }
  return devices;
}

EglContext::EglContext(const std::string& device) {
  if (device != "auto" && device != "gpu" && device != "software")
    throw Error("device \"" + device + "\"", "must be auto, gpu or software");
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  const std::vector<EglDevice> devices = egl_devices();
  for (const bool software : {false, true}) {
    if (device == (software ? "gpu" : "software")) continue;
    for (const EglDevice& each : devices)
      if (each.software == software && open(each)) return;
  }
  refuse(device);
}

bool EglContext::open(const EglDevice& device) {
  void* display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return false;
  display_ = display;
  if (make_current() && draws_as(renderer(), device.software)) return true;
  close();
  eglTerminate(display);
  display_ = surface_ = context_ = nullptr;
  return false;
}

bool EglContext::make_current() {
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
  if (!eglBindAPI(EGL_OPENGL_API) ||
      !eglChooseConfig(display_, wanted.data(), &config, 1, &count) || count != 1)
    return false;
  surface_ = eglCreatePbufferSurface(display_, config, size.data());
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version.data());
  return context_ && surface_ && eglMakeCurrent(display_, surface_, surface_, context_);
}

// The display stays open: others in the process may draw on it.
EglContext::~EglContext() {
  close();
}

void EglContext::close() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_) eglDestroyContext(display_, context_);
  if (surface_) eglDestroySurface(display_, surface_);
}

std::string EglContext::renderer() const {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

}  // namespace seam
