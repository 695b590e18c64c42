#include "features/highlight_mask.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "features/feature_settings.h"
#include "features/mask_morphology.h"

namespace softscope {

void HighlightOptions::validate() const { requireAllowed(*this); }

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
