// src/stereo/images/gradient_image.h: Sobel responses as bytes, the descriptors of ELAS.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "stereo/kernels/matching_kernels.h"

namespace softscope {

/// Horizontal and vertical Sobel responses times `gain`, clamped to 8 bits around
/// 128. A margin of 128s surrounds the image, wide enough for all disparities and
/// windows, so that inner loops need no border cases. Pixels under `mask` must
/// have been filled (fillMasked()); blocked() marks windows that reach them.
class GradientImage {
 public:
  GradientImage(const GrayImage& image, double gain, int margin_px, const Mask& mask = {});

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  /// Row 0 of the view is row `first_row` of the image, within kRowMargin.
  GradientView view(int first_row = 0) const;

  /// 1 where a window of `reach_px` to each side
  /// uses a masked pixel; empty without a mask.
  Mask blocked(int reach_px) const;

  static constexpr int kRowMargin = 2 * kTileHeight;  // rows of 128 above and below

 private:
  int width_px_, height_px_, stride_;
  std::size_t origin_;  // offset of pixel (0, 0)
  std::vector<std::uint16_t> packed_;
  Mask mask_;
};

}  // namespace softscope
