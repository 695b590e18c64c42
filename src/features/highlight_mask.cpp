#include "features/highlight_mask.h"

#include <algorithm>

#include "core/mask_morphology.h"
#include "core/parallel.h"

namespace softscope {

namespace {

constexpr int kHighlightBrightness = 235;      // minimum, of the brightest channel
constexpr double kHighlightSaturation = 0.25;  // maximum (max - min) / max of the channels
constexpr int kHighlightHaloPx = 1;            // dilation: the halo is part of the highlight

}  // namespace

Mask highlightMask(const ColourImage& image) {
  Mask mask(image.width_px, image.height_px, 0);
  const int width = image.width_px;
  const int saturation_q8 = static_cast<int>(256 * kHighlightSaturation);
  parallelRows(image.height_px, [&](int v) {
    const Rgb8* in = image.row(v);
    std::uint8_t* mark = mask.row(v);
    for (int u = 0; u < width; ++u) {
      const int most = std::max({in[u].red, in[u].green, in[u].blue});
      const int least = std::min({in[u].red, in[u].green, in[u].blue});
      mark[u] = most >= kHighlightBrightness && 256 * (most - least) <= saturation_q8 * most;
    }
  });
  return dilated(mask, kHighlightHaloPx);
}

}  // namespace softscope
