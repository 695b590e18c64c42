// eval/images/pixel_masks.cpp: masks from maps, and checks of their sizes.
#include "eval/images/pixel_masks.h"

#include <cmath>
#include <string>

#include "core/error.h"

namespace softscope {
namespace {

template <class T>
std::string sizeOf(const Raster<T>& raster) {
  return std::to_string(raster.width_px) + " x " + std::to_string(raster.height_px);
}

}  // namespace

Mask ignoreUnmeasured(const Raster<float>& values) {
  Mask mask(values.width_px, values.height_px);
  for (std::size_t i = 0; i < values.size(); ++i) mask.values[i] = !std::isfinite(values.values[i]);
  return mask;
}

Mask ignoreMatchesOutside(const Raster<float>& disparity_px) {
  Mask mask(disparity_px.width_px, disparity_px.height_px);
  for (int v = 0; v < mask.height_px; ++v)
    for (int u = 0; u < mask.width_px; ++u) {
      const float match_u = static_cast<float>(u) - disparity_px.at(u, v);
      const bool inside = match_u >= 0 && match_u <= static_cast<float>(mask.width_px - 1);
      mask.at(u, v) = !inside;  // true for a NaN disparity
    }
  return mask;
}

Mask ignoreEither(const Mask& first, const Mask& second) {
  if (first.empty()) return second;
  if (second.empty()) return first;
  if (!first.sameShape(second))
    throw InputError("one mask is " + sizeOf(first) + " pixels, the other " + sizeOf(second) +
                     "; give masks of one size");
  Mask both = first;
  for (std::size_t i = 0; i < both.size(); ++i) both.values[i] |= second.values[i];
  return both;
}

void requireSameShape(const Raster<float>& map, const Mask& mask, const char* what) {
  if (mask.empty() || map.sameShape(mask)) return;
  throw InputError(std::string("the ") + what + " is " + sizeOf(map) + " pixels, but the mask is " +
                   sizeOf(mask) + "; give a mask of the same size");
}

void requireSameShape(const Raster<float>& measured, const Raster<float>& truth, const char* what) {
  if (measured.sameShape(truth)) return;
  throw InputError(std::string("the measured ") + what + " is " + sizeOf(measured) +
                   " pixels, but the truth is " + sizeOf(truth) + "; compare maps of one size");
}

}  // namespace softscope
