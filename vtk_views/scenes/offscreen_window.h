// vtk_views/scenes/offscreen_window.h: render windows for machines without a display.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <string>

namespace softscope {

/// Render window without an X server. vtkRenderWindow::New() must not be
/// called before installOffscreenFactory(): without a display the default
/// window aborts the process. `samples` > 1 smooths edges and needs 3 to 4
/// times the frame time on Mesa. Throws BackendError without a renderer.
vtkSmartPointer<vtkRenderWindow> makeOffscreenWindow(int width_px, int height_px, int samples = 0);

/// Makes every vtkRenderWindow::New() of this process off-screen, including that of vtkContextView.
void installOffscreenFactory();

/// Description of the renderer from the driver. Throws BackendError without a renderer.
std::string offscreenDescription();

}  // namespace softscope
