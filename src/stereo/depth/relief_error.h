// src/stereo/depth/relief_error.h: what windows level out of the tissue's relief.
#pragma once

#include "core/depth_map.h"
#include "core/stereo_rig.h"

namespace softscope {

/// Disparity of the rectified left camera, px, by which windows level the relief out, as far as the
/// depth itself still bends: docs/stereo.md (9). NaN where nothing was measured. Same input, same
/// bytes.
Raster<float> reliefErrorPx(const Raster<float>& depth_mm, const RectifiedRig& rig);

/// Adds it to predicted standard errors, where there are any. `disparity` may be null or empty.
void addReliefError(const RectifiedRig& rig, DisparityMap* disparity, DepthMap* depth);

}  // namespace softscope
