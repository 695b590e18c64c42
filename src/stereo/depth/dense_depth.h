// src/stereo/depth/dense_depth.h: a depth for every pixel of tissue.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"

namespace softscope {

/// Keeps measured values and fills the gaps between and around them: docs/stereo.md
/// §9. `ignored` pixels (no tissue; may be empty, otherwise of the same shape) stay
/// NaN. The standard error of a filled pixel combines the error of the same fill at
/// the same distance from measured pixels, determined by removing measured pixels
/// around the gaps, and the spread of the values it is filled from. Same input,
/// same bytes. Throws InputError with fewer than `kLeastMeasured` measured pixels.
DepthMap denseDepth(const DepthMap& measured, const Mask& ignored);

constexpr int kLeastMeasured = 100;

}  // namespace softscope
