// src/features/highlight_mask.h: where the light is mirrored, and the tissue can't be seen.
#pragma once

#include "core/image.h"

namespace softscope {

struct HighlightOptions {
  int min_brightness = 235;      // of the brightest channel, 0 to 255
  double max_saturation = 0.25;  // (max - min) / max of the channels
  int grow_px = 3;               // the halo around them goes too

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// 1 at specular highlights: bright and colourless pixels, and their surroundings. Same shape.
Mask highlightMask(const ColourImage& image, const HighlightOptions& options);

}  // namespace softscope
