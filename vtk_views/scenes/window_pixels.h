// vtk_views/scenes/window_pixels.h: conversion between images and VTK.
#pragma once

#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include "core/image.h"

namespace softscope {

/// Three bytes per pixel, bottom row first.
vtkSmartPointer<vtkImageData> vtkImageOf(const ColourImage& picture);

/// Lower left `finer * width_px` by `finer * height_px` pixels of the window,
/// averaged over `finer` x `finer`: smooth edges, for a larger window.
ColourImage readPixels(vtkRenderWindow* window, int width_px, int height_px, int finer);

}  // namespace softscope
