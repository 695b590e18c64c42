// src/stereo/matching/host_prior.h: the prior by planes for a back end that finds support points
// elsewhere.
#pragma once

#include <cstdint>
#include <functional>

#include "core/raster.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Disparity prior of both views, and its support points.
struct HostPrior {
  Raster<float> support;  // on the grid, kNoSupport without a point
  int point_count = 0;
  Raster<std::int16_t> left_px8, right_px8;  // see interpolatePlanes()
};

/// `confirmed`: disparities on the grid of one
/// level, kNoSupport for none; `level`: its options.
using HostPriorFunction = std::function<HostPrior(
    const Raster<float>& confirmed, const StereoOptions& level, int width_px, int height_px)>;

/// That function.
HostPrior planePrior(const Raster<float>& confirmed, const StereoOptions& level, int width_px,
                     int height_px);

}  // namespace softscope
