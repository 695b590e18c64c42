#include "toolkit/face/image_copies.h"

#include <cstring>

#include "core/error.h"
#include "io/message.h"

namespace softscope::api {

static_assert(sizeof(Rgb8) == 3, "rows of Rgb8 are rows of bytes");

ColourImage colourImageOf(const ImageView& view, const char* what) {
  if (view.values == nullptr || view.width_px <= 0 || view.height_px <= 0)
    throw InputError(say(what, ": is empty; give an image of the left and of the right camera"));
  if (view.channels != 1 && view.channels != 3)
    throw InputError(say(what, ": has ", view.channels, " channels; give 1 or 3 (RGB)"));
  ColourImage image(view.width_px, view.height_px);
  if (view.channels == 3) {
    std::memcpy(image.values.data(), view.values, 3 * image.size());
    return image;
  }
  for (std::size_t i = 0; i < image.size(); ++i)
    image.values[i] = {view.values[i], view.values[i], view.values[i]};
  return image;
}

Mask maskOf(const ImageView& view) {
  if (view.values == nullptr) return {};
  if (view.channels != 1) throw InputError(say("mask: has ", view.channels, " channels; give one"));
  Mask mask(view.width_px, view.height_px);
  mask.values.assign(view.values, view.values + mask.size());
  return mask;
}

Image imageOf(const ColourImage& image) {
  Image copy{image.width_px, image.height_px, 3, {}};
  copy.values.resize(3 * image.size());
  if (!image.empty()) std::memcpy(copy.values.data(), image.values.data(), copy.values.size());
  return copy;
}

Image imageOf(const Mask& mask) { return {mask.width_px, mask.height_px, 1, mask.values}; }

}  // namespace softscope::api
