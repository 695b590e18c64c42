// src/core/frame.h: images, masks and time of one frame of a sequence.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/depth_map.h"
#include "core/image.h"

namespace softscope {

struct Frame {
  int index = 0;                                             // position in the sequence, from 0
  double time_s = std::numeric_limits<double>::quiet_NaN();  // NaN without timestamps
  StereoPair pair;
  Mask mask;               // empty without masks
  Raster<float> depth_mm;  // from depth/NNNNNN; NaN = unmeasured; empty without depth files
};

/// Those that follow the one at hand, in order, as far as they are known; none is null.
using UpcomingFrames = std::vector<std::shared_ptr<const Frame>>;

}  // namespace softscope
