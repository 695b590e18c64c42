#include "io/images/picture_limits.h"

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {

void requirePictureSize(long width_px, long height_px, const std::string& what) {
  if (width_px >= 1 && height_px >= 1 && width_px <= kMostSidePx && height_px <= kMostSidePx &&
      width_px * height_px <= kMostPixels)
    return;
  throw InputError(say(what, ": ", width_px, " x ", height_px, " pixels, but 1 x 1 to ",
                       kMostSidePx, " pixels a side and ", kMostPixels >> 20,
                       " megapixels in all are expected. ", "Is the file damaged?"));
}

}  // namespace softscope
