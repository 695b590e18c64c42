// vtk_views/viewer/x_display.h: check for an X display.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>

namespace softscope {

/// Throws BackendError if DISPLAY is not set, its server is unreachable or lacks OpenGL. The window
/// of VTK would end the process instead. The result must be kept until the window is open: a server
/// may restart after its last client disconnects, and is then unreachable for a short time.
std::shared_ptr<void> connectToDisplay();

/// Window on that display, independent of installOffscreenFactory().
vtkSmartPointer<vtkRenderWindow> newWindowOnDisplay();

}  // namespace softscope
