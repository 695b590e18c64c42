// vtk_views/viewer/x_display.cpp: query of the X server with a kept connection.
#include "vtk_views/viewer/x_display.h"

#include <X11/Xlib.h>
#include <vtkXOpenGLRenderWindow.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "core/error.h"

namespace softscope {

std::shared_ptr<void> connectToDisplay() {
  const char* name = std::getenv("DISPLAY");
  const std::string instead =
      "Without a display, `screenshot=` FILE.png and `movie=` FILE.mp4 work all the same";
  if (name == nullptr || *name == '\0')
    throw BackendError("a window needs a display, but DISPLAY is not set. " + instead);
  const std::shared_ptr<Display> display(XOpenDisplay(name), [](Display* opened) {
    if (opened != nullptr) XCloseDisplay(opened);
  });
  if (!display)
    throw BackendError("a window needs a display, but `" + std::string(name) +
                       "` (DISPLAY) can't be opened. " + instead);
  int opcode = 0, event = 0, error = 0;
  if (XQueryExtension(display.get(), "GLX", &opcode, &event, &error) == 0)
    throw BackendError("the display `" + std::string(name) + "` draws no OpenGL (GLX). " + instead);
  return display;
}

vtkSmartPointer<vtkRenderWindow> newWindowOnDisplay() {
  return vtkSmartPointer<vtkXOpenGLRenderWindow>::New();
}

}  // namespace softscope
