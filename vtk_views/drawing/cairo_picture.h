// vtk_views/drawing/cairo_picture.h: pixels to cairo and back.
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

/// Throws Error in cairo's words unless all went well.
void requireGoodCairo(cairo_status_t status);

/// Black, without transparency. Throws Error where cairo refuses the size.
CairoSurface newCairoPixels(int width_px, int height_px);

CairoSurface toCairo(const ColourImage& picture);

/// Of a surface that newCairoPixels() made.
ColourImage fromCairo(cairo_surface_t* surface);

/// A PNG file of the image. The same image gives the same bytes.
std::string pngBytes(const ColourImage& picture);

}  // namespace softscope
