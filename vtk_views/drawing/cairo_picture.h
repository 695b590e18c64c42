// vtk_views/drawing/cairo_picture.h: conversion between images and cairo surfaces.
#pragma once

#include <cairo/cairo.h>

#include <memory>
#include <string>

#include "core/image.h"

namespace softscope {

struct DestroyCairo {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, DestroyCairo>;
using CairoContext = std::unique_ptr<cairo_t, DestroyCairo>;

/// Throws Error with the message of cairo unless the status is success.
void requireGoodCairo(cairo_status_t status);

/// Black, opaque. Throws Error for an unsupported size.
CairoSurface newCairoPixels(int width_px, int height_px);

CairoSurface toCairo(const ColourImage& picture);

/// Requires a surface of newCairoPixels().
ColourImage fromCairo(cairo_surface_t* surface);

/// PNG file of the image; deterministic.
std::string pngBytes(const ColourImage& picture);

}  // namespace softscope
