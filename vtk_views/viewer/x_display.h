// vtk_views/viewer/x_display.h: check for an X display.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>

namespace softscope {

/// Throws BackendError where DISPLAY is not set, its server can't be reached, or draws no OpenGL.
/// VTK's own window would end the process instead. Keep what is returned until the window is open:
/// a server whose last client leaves may start anew, and then answers nobody for a moment.
std::shared_ptr<void> connectToDisplay();

/// A window on that display, whatever installOffscreenFactory() made of other windows.
vtkSmartPointer<vtkRenderWindow> newWindowOnDisplay();

}  // namespace softscope
