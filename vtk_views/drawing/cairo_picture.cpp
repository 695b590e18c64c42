// vtk_views/drawing/cairo_picture.cpp: conversion to and from
// cairo's RGB24, one 32-bit word per pixel, blue in the lowest byte.
#include "vtk_views/drawing/cairo_picture.h"

#include <cstring>

#include "core/error.h"

namespace softscope {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void requireGoodCairo(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("figure: ") + cairo_status_to_string(status));
}

CairoSurface newCairoPixels(int width_px, int height_px) {
  CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px));
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error("figure of " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                " pixels: " + cairo_status_to_string(status));
  return surface;
}

CairoSurface toCairo(const ColourImage& picture) {
  CairoSurface surface = newCairoPixels(picture.width_px, picture.height_px);
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (int v = 0; v < picture.height_px; ++v)
    for (int u = 0; u < picture.width_px; ++u) {
      const Rgb8 c = picture.at(u, v);
      const std::uint32_t word = std::uint32_t(c.red) << 16 | std::uint32_t(c.green) << 8 | c.blue;
      std::memcpy(data + std::size_t(v) * stride + std::size_t(u) * 4, &word, 4);
    }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

ColourImage fromCairo(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  ColourImage picture(cairo_image_surface_get_width(surface),
                      cairo_image_surface_get_height(surface));
  for (int v = 0; v < picture.height_px; ++v)
    for (int u = 0; u < picture.width_px; ++u) {
      std::uint32_t word = 0;
      std::memcpy(&word, data + std::size_t(v) * stride + std::size_t(u) * 4, 4);
      picture.at(u, v) = {std::uint8_t(word >> 16), std::uint8_t(word >> 8), std::uint8_t(word)};
    }
  return picture;
}

std::string pngBytes(const ColourImage& picture) {
  std::string bytes;
  requireGoodCairo(cairo_surface_write_to_png_stream(toCairo(picture).get(), append, &bytes));
  return bytes;
}

}  // namespace softscope
