// src/stereo/depth/levelled_relief.h: variance of a frame's depth by relief finer than two windows.
#pragma once

#include "core/depth_map.h"
#include "core/rectified_rig.h"

namespace softscope {

/// One value per square of kStepPx pixels; NaN where nothing was measured.
struct LevelledRelief {
  static constexpr int kStepPx = 4;

  Raster<float> depth_mm;
  /// Of the relief that stereo's windows level out, which errs alike in every frame:
  /// docs/fusion.md (F30).
  Raster<float> variance_mm2;
};

/// One pixel's depth of each square.
Raster<float> depthOfSquares(const Raster<float>& depth_mm);

/// From depthOfSquares(). Same input, same bytes.
LevelledRelief levelledRelief(Raster<float> depth_mm, const RectifiedRig& rig);

}  // namespace softscope
