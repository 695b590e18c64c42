// vtk_views/scenes/window_pixels.h: images to VTK and back.
#pragma once

#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include "core/image.h"

namespace softscope {

/// Three bytes a pixel, the first row at the bottom.
vtkSmartPointer<vtkImageData> vtkImageOf(const ColourImage& picture);

/// The lower left `finer * width_px` by `finer * height_px` pixels of the window, as means of
/// `finer` x `finer` of them: smooth edges at the price of a larger window.
ColourImage readPixels(vtkRenderWindow* window, int width_px, int height_px, int finer);

}  // namespace softscope
