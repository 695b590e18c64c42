// src/stereo/refinement/plane.h: image of floats with a margin, so that windows need no border
// cases.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Rows are readable and writable kMargin values beyond
/// either end, with `row_margin` rows above and below.
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

/// Brightness in two parts. The first three values of the side margins repeat the border.
struct BrightnessParts {
  Plane fast;  // with a little less noise: a 3 x 3 binomial filter minus the slow part
  Plane slow;  // a Gaussian of `sigma_px`
};
BrightnessParts splitBrightness(const GrayImage& image, double sigma_px);

}  // namespace softscope
