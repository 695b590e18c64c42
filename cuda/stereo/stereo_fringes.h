// cuda/stereo/stereo_fringes.h: kernel body that doubts pixels at the end of a measured area.
#pragma once

#include "cuda/device/kernel.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope::cuda {

/// Raises the error of pixels that look like the unmeasured ones beside them.
struct DoubtFringesBody {
  View<const std::uint8_t> gray;
  View<const float> disparity;
  View<float> sigma;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    if (!isNumber(disparity.at(u, v))) return;
    const auto disparityAt = [&](int x, int y) {
      return disparity.contains(u + x, v + y) ? disparity.at(u + x, v + y) : quietNan();
    };
    const auto pixelAt = [&](int x, int y) { return gray.at(x, y); };
    const auto grayAt = [&](int x, int y) {
      return gray.contains(u + x, v + y)
                 ? meanAround(u + x, v + y, gray.width, gray.height, pixelAt)
                 : quietNan();
    };
    if (isFringe(disparityAt, grayAt)) sigma.at(u, v) = sigmaAtRim(sigma.at(u, v));
  }
};

}  // namespace softscope::cuda
