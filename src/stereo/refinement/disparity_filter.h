// src/stereo/refinement/disparity_filter.h: removal of inconsistent disparities and filling of
// small gaps (ELAS §3.4).
#pragma once

#include <cstdint>

#include "core/depth_map.h"
#include "core/image.h"
#include "core/raster.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Left disparities that the right image confirms within
/// `tolerance_px`; otherwise NaN. Input -1 = unmatched.
Raster<float> checkLeftRight(const Raster<std::int16_t>& left, const Raster<std::int16_t>& right,
                             int tolerance_px);

/// Removes pixels within `margin_px` of one darker than `darkest_gray`: too dark to be
/// matched; next to dark regions the window contains more of their border than of the tissue.
void removeDark(Raster<float>& disparity_px, const GrayImage& left, int darkest_gray,
                int margin_px);

/// Removes islands of fewer than `size_px` pixels whose neighbours differ by at most `step_px`.
void removeSpeckles(Raster<float>& disparity_px, int size_px, double step_px);

/// Fills gaps of up to `width_px` pixels in rows, then in
/// columns, linearly, if both sides differ by at most `step_px`.
void fillGaps(Raster<float>& disparity_px, int width_px, double step_px);

/// Removes measured pixels within `reach_px` of a step of more than `step_px`
/// between neighbours, and within `border_px` of the border of the image.
void erodeEdges(DisparityMap& map, int reach_px, double step_px, int border_px);

}  // namespace softscope
