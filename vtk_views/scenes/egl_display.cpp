// vtk_views/scenes/egl_display.cpp: search
// of an EGL device with a working context.
#include "vtk_views/scenes/egl_display.h"

#include <EGL/eglext.h>
#include <GL/gl.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/error.h"

namespace softscope {
namespace {

bool clientHas(const char* extension) {
  const char* all = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return all != nullptr && std::strstr(all, extension) != nullptr;
}

template <class Function>
Function entryPoint(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::string orUnknown(const void* text) {
  return text == nullptr ? "unknown" : static_cast<const char*>(text);
}

}  // namespace

std::vector<std::size_t> deviceOrder(const std::vector<std::string>& extensions) {
  std::vector<std::size_t> order(extensions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) {
    return extensions[i].find("EGL_MESA_device_software") == std::string::npos;
  });
  return order;
}

const EglDisplay& EglDisplay::instance() {
  static const EglDisplay display;
  return display;
}

EglDisplay::EglDisplay() {
  if (tryDevices() || trySurfaceless()) return;
  if (accept(eglGetDisplay(EGL_DEFAULT_DISPLAY), "default display")) return;
  throw BackendError(
      "off-screen rendering: no EGL device of this machine offers OpenGL 3.2. Install libegl1 "
      "(with "
      "libgl1-mesa-dri for software rendering) or the GPU's driver");
}

bool EglDisplay::tryDevices() {
  if (!clientHas("EGL_EXT_platform_device")) return false;
  const auto platform_display =
      entryPoint<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  const auto query_devices = entryPoint<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  EGLint count = 0;
  if (!platform_display || !query_devices || !query_devices(0, nullptr, &count) || count < 1)
    return false;
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  query_devices(count, devices.data(), &count);
  const auto query_text = entryPoint<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  std::vector<std::string> extensions;
  for (EGLDeviceEXT device : devices)
    extensions.push_back(query_text ? orUnknown(query_text(device, EGL_EXTENSIONS)) : "");
  for (const std::size_t i : deviceOrder(extensions))
    if (accept(platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr),
               "device " + std::to_string(i)))
      return true;
  return false;
}

bool EglDisplay::trySurfaceless() {
  if (!clientHas("EGL_MESA_platform_surfaceless")) return false;
  const auto platform_display =
      entryPoint<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  return platform_display &&
         accept(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                "surfaceless");
}

bool EglDisplay::accept(EGLDisplay candidate, const std::string& what) {
  EGLint major = 0, minor = 0;
  if (candidate == EGL_NO_DISPLAY || !eglInitialize(candidate, &major, &minor)) return false;
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_NONE};
  EGLint count = 0;
  display_ = candidate;
  if (eglChooseConfig(display_, wanted, &config_, 1, &count) && count > 0 && describe(what))
    return true;
  display_ = EGL_NO_DISPLAY;
  eglTerminate(candidate);
  return false;
}

/// True if a context becomes current; the description contains the text of the driver.
bool EglDisplay::describe(const std::string& what) {
  const EGLSurface surface = newSurface();
  const EGLContext context = newContext();
  const bool works =
      context != EGL_NO_CONTEXT && eglMakeCurrent(display_, surface, surface, context);
  if (works) {
    description_ = what + ": " + orUnknown(eglQueryString(display_, EGL_VENDOR)) + ", EGL " +
                   orUnknown(eglQueryString(display_, EGL_VERSION)) + ", " +
                   orUnknown(glGetString(GL_RENDERER));
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  if (context != EGL_NO_CONTEXT) eglDestroyContext(display_, context);
  if (surface != EGL_NO_SURFACE) eglDestroySurface(display_, surface);
  return works;
}

EGLContext EglDisplay::newContext() const {
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           3,
                           EGL_CONTEXT_MINOR_VERSION,
                           2,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_NONE};
  eglBindAPI(EGL_OPENGL_API);  // per thread
  return eglCreateContext(display_, config_, EGL_NO_CONTEXT, wanted);
}

EGLSurface EglDisplay::newSurface() const {
  const EGLint wanted[] = {EGL_WIDTH, 8, EGL_HEIGHT, 8, EGL_NONE};
  return eglCreatePbufferSurface(display_, config_, wanted);
}

}  // namespace softscope
