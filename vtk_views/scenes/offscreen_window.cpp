// vtk_views/scenes/offscreen_window.cpp: generic OpenGL window of VTK on an own EGL context.
#include "vtk_views/scenes/offscreen_window.h"

#include <GL/glew.h>  // before any other GL header
#include <vtkAutoInit.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkVersion.h>

#include "core/error.h"
#include "vtk_views/scenes/egl_display.h"

// Registered in the file that every rendering program links: vtk_module_autoinit()
// works per file and included header, and omits some without a message.
VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);
VTK_MODULE_INIT(vtkRenderingContextOpenGL2);
VTK_MODULE_INIT(vtkRenderingGL2PSOpenGL2);
VTK_MODULE_INIT(vtkInteractionStyle);
VTK_MODULE_INIT(vtkRenderingUI);

namespace softscope {
namespace {

class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)

  void Initialize() override {
    if (context_ != EGL_NO_CONTEXT) return;
    const EglDisplay& egl = EglDisplay::instance();
    surface_ = egl.newSurface();
    context_ = egl.newContext();
    if (context_ == EGL_NO_CONTEXT)
      throw BackendError("off-screen rendering: " + egl.description() + " gives no more contexts");
    MakeCurrent();
    OpenGLInit();
  }

  void Finalize() override {
    if (context_ == EGL_NO_CONTEXT) return;
    const EGLDisplay display = EglDisplay::instance().handle();
    MakeCurrent();
    Superclass::Finalize();  // frees all GL objects while its context is current
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context_);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display, surface_);
    context_ = EGL_NO_CONTEXT;
    surface_ = EGL_NO_SURFACE;
    Initialized = false;
  }

  void MakeCurrent() override {
    if (context_ != EGL_NO_CONTEXT && !IsCurrent())
      eglMakeCurrent(EglDisplay::instance().handle(), surface_, surface_, context_);
  }
  bool IsCurrent() override {
    return context_ != EGL_NO_CONTEXT && eglGetCurrentContext() == context_;
  }
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 1; }

  void Render() override {
    Initialize();
    MakeCurrent();
    Superclass::Render();
  }

  /// Debian's GLEW is built for GLX: glewInit() loads all OpenGL entry points, then
  /// reports a missing GLX display. The implementation of VTK would fail there.
  void OpenGLInitContext() override {
    ContextCreationTime.Modified();
    if (Initialized) return;
    const GLenum outcome = glewInit();
    GlewInitValid = outcome == GLEW_OK || outcome == GLEW_ERROR_NO_GLX_DISPLAY;
    if (!GlewInitValid || !GLEW_VERSION_3_2)
      throw BackendError("off-screen rendering: " + EglDisplay::instance().description() +
                         " lacks OpenGL 3.2. Update its driver, or install libgl1-mesa-dri");
    Initialized = true;
    GLfloat range[2] = {1.f, 1.f};
    glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, range);
    MaximumHardwareLineWidth = range[1];
  }

 protected:
  OffscreenWindow() {
    SetShowWindow(false);
    SetUseOffScreenBuffers(true);
    SetFrameBlitModeToNoBlit();
    ReadyForRendering = true;
  }
  ~OffscreenWindow() override { OffscreenWindow::Finalize(); }

 private:
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};
vtkStandardNewMacro(OffscreenWindow);

vtkObject* createOffscreenWindow() { return OffscreenWindow::New(); }

class OffscreenFactory : public vtkObjectFactory {
 public:
  static OffscreenFactory* New() {
    auto* factory = new OffscreenFactory;
    factory->InitializeObjectBase();
    return factory;
  }
  vtkTypeMacro(OffscreenFactory, vtkObjectFactory)
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return "display-less render windows"; }

 protected:
  OffscreenFactory() {
    RegisterOverride("vtkRenderWindow", "OffscreenWindow", "EGL render window", 1,
                     createOffscreenWindow);
  }
};

}  // namespace

vtkSmartPointer<vtkRenderWindow> makeOffscreenWindow(int width_px, int height_px, int samples) {
  auto window = vtkSmartPointer<OffscreenWindow>::New();
  window->SetSize(width_px, height_px);
  window->SetMultiSamples(samples);
  window->Initialize();
  return window;
}

std::string offscreenDescription() { return EglDisplay::instance().description(); }

void installOffscreenFactory() {
  static const bool once = [] {
    vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindow");  // else the first one is used
    vtkNew<OffscreenFactory> factory;
    vtkObjectFactory::RegisterFactory(factory);
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace softscope
