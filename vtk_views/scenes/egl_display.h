// vtk_views/scenes/egl_display.h: OpenGL context without a display.
#pragma once

#include <EGL/egl.h>

#include <cstddef>
#include <string>
#include <vector>

namespace softscope {

/// Order of devices by their extensions: GPUs in the listed order, then software.
/// Mesa lists software first, although a GPU renders 10 to 100 times faster.
std::vector<std::size_t> deviceOrder(const std::vector<std::string>& extensions);

/// First EGL display of this machine with OpenGL 3.2: a GPU, or the software
/// device of Mesa. One per process, because eglTerminate() would destroy the
/// contexts of all other windows; windows own contexts and surfaces only.
class EglDisplay {
 public:
  /// Throws BackendError without a display; a later call tries again.
  static const EglDisplay& instance();

  EGLDisplay handle() const { return display_; }
  /// "device 0: Mesa Project, EGL 1.5, llvmpipe (LLVM 15.0.6, 256 bits)"
  const std::string& description() const { return description_; }

  EGLContext newContext() const;  // OpenGL 3.2 core; EGL_NO_CONTEXT on failure
  EGLSurface newSurface() const;  // 8 x 8 pixels: VTK renders into its own buffers

 private:
  EglDisplay();
  bool tryDevices();
  bool trySurfaceless();
  bool accept(EGLDisplay candidate, const std::string& what);
  bool describe(const std::string& what);

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLConfig config_ = nullptr;
  std::string description_;
};

}  // namespace softscope
