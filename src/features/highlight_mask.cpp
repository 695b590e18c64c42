#include "features/highlight_mask.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "features/mask_morphology.h"

namespace softscope {

void HighlightOptions::validate() const {
  require(min_brightness >= 1 && min_brightness <= 255, "highlights.min_brightness", min_brightness,
          "must lie between 1 and 255");
  require(max_saturation >= 0 && max_saturation <= 1, "highlights.max_saturation", max_saturation,
          "must lie between 0 and 1");
  require(grow_px >= 0, "highlights.grow_px", grow_px, "can't be negative");
}

Mask highlightMask(const ColourImage& image, const HighlightOptions& options) {
  options.validate();
  Mask mask(image.width_px, image.height_px, 0);
  const int saturation_q8 = static_cast<int>(256 * options.max_saturation);
  parallelRows(image.height_px, [&](int v) {
    const Rgb8* in = image.row(v);
    for (int u = 0; u < image.width_px; ++u) {
      const int most = std::max({in[u].red, in[u].green, in[u].blue});
      const int least = std::min({in[u].red, in[u].green, in[u].blue});
      mask.at(u, v) =
          most >= options.min_brightness && 256 * (most - least) <= saturation_q8 * most;
    }
  });
  return grown(mask, options.grow_px);
}

}  // namespace softscope
