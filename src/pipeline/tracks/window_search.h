// src/pipeline/tracks/window_search.h: position of one window of a first look in an image.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pipeline/tracks/first_look.h"

namespace softscope {

/// State of the search.
struct LookSearch {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d map;     // pixels of the image per pixel of the window
  bool converged = false;  // at the pixel, found or not
  double correlation = 0;
  double sigma_px = 0;  // predicted standard error along the worst direction
};

/// Moves the search from the expected position of the window to the measured one; false if
/// it is not found. `image_from_look`: the expected map; the search may start elsewhere.
bool findWindow(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore,
                const Eigen::Matrix2d& image_from_look, LookSearch* search);

/// Offset of pixel i of a window from its centre.
inline Eigen::Vector2d windowOffset(int i) {
  return {i % FirstLook::kSidePx - FirstLook::kHalfPx, i / FirstLook::kSidePx - FirstLook::kHalfPx};
}

/// Whether a bilinear sample is inside the image.
inline bool sampleable(const GrayImage& image, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < image.width_px - 1 &&
         pixel.y() < image.height_px - 1;
}

/// Bilinear sample at a position inside the image.
inline double sampleAt(const GrayImage& image, double u, double v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const double across = u - u0, down = v - v0;
  const std::uint8_t* above = image.row(v0) + u0;
  const std::uint8_t* below = above + image.width_px;
  const double first = above[0] + across * (above[1] - above[0]);
  const double second = below[0] + across * (below[1] - below[0]);
  return first + down * (second - first);
}

/// Whether a masked pixel contributes to it.
inline bool ignoredAt(const Mask& ignore, double u, double v) {
  if (ignore.empty()) return false;
  const std::uint8_t* above = ignore.row(static_cast<int>(v)) + static_cast<int>(u);
  const std::uint8_t* below = above + ignore.width_px;
  return (above[0] | above[1] | below[0] | below[1]) != 0;
}

}  // namespace softscope
