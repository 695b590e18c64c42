#include "stereo/refinement/clipped_mask.h"

#include <algorithm>
#include <atomic>

#include "core/mask_morphology.h"
#include "core/parallel.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

constexpr int kClippedBrightness = 250;  // minimum, of the darkest channel

}  // namespace

Mask clippedMask(const ColourImage& image) {
  Mask mask(image.width_px, image.height_px, 0);
  std::atomic<bool> any{false};
  parallelRows(image.height_px, [&](int v) {
    const Rgb8* in = image.row(v);
    std::uint8_t* mark = mask.row(v);
    std::uint8_t in_row = 0;
    for (int u = 0; u < image.width_px; ++u) {
      mark[u] = std::min({in[u].red, in[u].green, in[u].blue}) >= kClippedBrightness;
      in_row |= mark[u];
    }
    if (in_row != 0) any = true;
  });
  return any ? eroded(mask, RefinementOptions::radius_px) : Mask();
}

}  // namespace softscope
