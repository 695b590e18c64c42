// src/pipeline/window_search.h: where an image shows one window of a first look.
#pragma once

#include <Eigen/Core>

#include "pipeline/first_look.h"

namespace softscope {

/// Where the search stands.
struct LookSearch {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d map;  // the image's pixels per pixel of the window
  double correlation = 0;
  double sigma_px = 0;  // predicted standard error along the worst direction
};

/// Moves the search from where the window is expected to where it is; false where it is not found.
/// `image_from_look`: the map that is expected, of which the search may begin elsewhere.
bool findWindow(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore,
                const Eigen::Matrix2d& image_from_look, LookSearch* search);

/// Pixel i of a window lies so far from its middle.
inline Eigen::Vector2d windowOffset(int i) {
  return {i % FirstLook::kSidePx - FirstLook::kHalfPx, i / FirstLook::kSidePx - FirstLook::kHalfPx};
}

/// Whether a bilinear sample lies inside the image.
inline bool sampleable(const GrayImage& image, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < image.width_px - 1 &&
         pixel.y() < image.height_px - 1;
}

/// Bilinear sample at a place inside the image.
double sampleAt(const GrayImage& image, const Eigen::Vector2d& pixel);

/// Does a masked pixel share in it?
bool ignoredAt(const Mask& ignore, const Eigen::Vector2d& pixel);

}  // namespace softscope
