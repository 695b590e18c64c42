// vtk_views/scenes/egl_display.h: OpenGL context without a display.
#pragma once

#include <EGL/egl.h>

#include <cstddef>
#include <string>
#include <vector>

namespace softscope {

/// In which order devices are tried, by what each says of its extensions: those of GPUs as they are
/// listed, then software. Mesa lists its software first, though a GPU draws 10 to 100 times faster.
std::vector<std::size_t> deviceOrder(const std::vector<std::string>& extensions);

/// The first EGL display of this machine that yields OpenGL 3.2: a GPU, or Mesa's software device.
/// One for the whole process, because eglTerminate() would kill the contexts of every other window;
/// windows own contexts and surfaces only.
class EglDisplay {
 public:
  /// Throws BackendError where there is none; a later call tries again.
  static const EglDisplay& instance();

  EGLDisplay handle() const { return display_; }
  /// "device 0: Mesa Project, EGL 1.5, llvmpipe (LLVM 15.0.6, 256 bits)"
  const std::string& description() const { return description_; }

  EGLContext newContext() const;  // OpenGL 3.2 core; EGL_NO_CONTEXT on failure
  EGLSurface newSurface() const;  // 8 x 8 pixels: drawing goes to VTK's own buffers

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
