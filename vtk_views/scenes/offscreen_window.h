// vtk_views/scenes/offscreen_window.h: render windows for machines without a display.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <string>

namespace softscope {

/// A render window that needs no X server. Never call vtkRenderWindow::New() before
/// installOffscreenFactory(): without a display the stock window aborts the process.
/// `samples` > 1 smooths edges and costs 3 to 4 times a frame on Mesa.
/// Throws BackendError where nothing on this machine renders.
vtkSmartPointer<vtkRenderWindow> makeOffscreenWindow(int width_px, int height_px, int samples = 0);

/// Makes every vtkRenderWindow::New() of this process display-less, vtkContextView's too.
void installOffscreenFactory();

/// What renders, as the driver says it. Throws BackendError where nothing does.
std::string offscreenDescription();

}  // namespace softscope
