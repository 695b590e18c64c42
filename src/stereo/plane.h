// src/stereo/plane.h: a picture of floats with a margin, so that windows need no border cases.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Rows may be read and written kMargin values beyond either end, and there are `row_margin` rows
/// above and below.
class Plane {
 public:
  static constexpr int kMargin = 16;

  Plane(int width, int height, float fill = 0, int row_margin = kMargin)
      : stride_((width + 2 * kMargin + 15) / 16 * 16),
        row_margin_(row_margin),
        values_(
            static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2 * row_margin),
            fill) {}
  float* row(int v) { return values_.data() + offset(v); }
  const float* row(int v) const { return values_.data() + offset(v); }

 private:
  std::size_t offset(int v) const {
    return static_cast<std::size_t>(v + row_margin_) * static_cast<std::size_t>(stride_) + kMargin;
  }
  int stride_, row_margin_;
  std::vector<float> values_;
};

/// Brightness without its slow part (light, exposure) and with a little less noise: a 3 x 3
/// binomial filter minus a Gaussian of `highpass_sigma_px`. The first three values of the side
/// margins repeat the border.
Plane bandPass(const GrayImage& image, double highpass_sigma_px);

}  // namespace softscope
