// src/core/raster.h: two-dimensional array with one value per pixel.
#pragma once

#include <cstddef>
#include <vector>

namespace softscope {

/// Shape: height_px x width_px, row-major; (0, 0) is the centre of the top-left pixel, u right,
/// v down.
template <class T>
struct Raster {
  int width_px = 0;
  int height_px = 0;
  std::vector<T> values;  // size: width_px * height_px

  Raster() = default;
  Raster(int width, int height, T fill = T())
      : width_px(width),
        height_px(height),
        values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

  bool empty() const { return values.empty(); }
  std::size_t size() const { return values.size(); }
  bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_px && v < height_px; }
  template <class U>
  bool sameShape(const Raster<U>& other) const {
    return width_px == other.width_px && height_px == other.height_px;
  }

  T* row(int v) { return values.data() + static_cast<std::size_t>(v) * width_px; }
  const T* row(int v) const { return values.data() + static_cast<std::size_t>(v) * width_px; }
  T& at(int u, int v) { return row(v)[u]; }
  const T& at(int u, int v) const { return row(v)[u]; }
};

}  // namespace softscope
