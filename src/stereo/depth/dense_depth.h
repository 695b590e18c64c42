// src/stereo/depth/dense_depth.h: a depth for every pixel of tissue, measured or not.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"

namespace softscope {

/// Keeps what was measured and fills the gaps between and beside it: docs/stereo.md §9. `ignored`
/// pixels (no tissue; may be empty, else of the same shape) stay NaN. The standard error of a
/// filled pixel is what the same fill errs by at the same distance from measured pixels, found by
/// taking measured pixels around the gaps away, and the spread of the values that it is filled
/// from. Same input, same bytes. Throws InputError where fewer than `kLeastMeasured` pixels were
/// measured.
DepthMap denseDepth(const DepthMap& measured, const Mask& ignored);

constexpr int kLeastMeasured = 100;

}  // namespace softscope
