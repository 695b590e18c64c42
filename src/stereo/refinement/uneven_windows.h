// src/stereo/refinement/uneven_windows.h: windows of a smaller size that hold no single surface.
#pragma once

#include "core/depth_map.h"

namespace softscope {

/// Drops the pixels of uneven windows (isUneven()) of (2 `radius_px` + 1)² pixels.
void dropUnevenWindows(int radius_px, DisparityMap* map);

}  // namespace softscope
