// src/stereo/refinement/subpixel_refinement.h: sub-pixel refinement of whole-pixel disparities.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Fits, around every pixel, the plane d(x, y) = D + a x + b y that best explains the brightness of
/// the window: each residual is linearised at the disparity of its pixel, so the window follows the
/// surface (docs/stereo.md §4). Returns refined disparities with their predicted standard error;
/// pixels with an error above max_sigma_px become NaN. `initial_px`: NaN = unmatched, unchanged.
DisparityMap refineDisparity(const GrayImage& left, const GrayImage& right,
                             const Raster<float>& initial_px, const RefinementOptions& options);

/// The same without the rules that drop pixels at smaller sizes.
DisparityMap refineEveryPixel(const GrayImage& left, const GrayImage& right,
                              const Raster<float>& initial_px, const RefinementOptions& options);

}  // namespace softscope
