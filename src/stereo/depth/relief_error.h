// src/stereo/depth/relief_error.h: relief of the tissue that windows level out.
#pragma once

#include "core/depth_map.h"
#include "core/stereo_rig.h"

namespace softscope {

/// Disparity error in the rectified left camera, px, by which windows
/// level out the relief, as far as the depth itself is still curved:
/// docs/stereo.md (9). NaN for unmeasured pixels. Same input, same bytes.
Raster<float> reliefErrorPx(const Raster<float>& depth_mm, const RectifiedRig& rig);

/// A pixel's predicted standard error of depth with that of its relief; NaN of the latter adds
/// none.
float sigmaWithRelief(const RectifiedRig& rig, float sigma_mm, float depth_mm, float error_px);

/// Adds it to predicted standard errors, if there are any. `disparity` may be null or empty.
void addReliefError(const RectifiedRig& rig, DisparityMap* disparity, DepthMap* depth);

}  // namespace softscope
