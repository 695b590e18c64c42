// src/stereo/refinement/patch_smoothing.h: smoothing of disparity by quadric patches of the
// neighbourhood.
#pragma once

#include "core/depth_map.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Tissue is smooth over a few millimetres; noise isn't. Every pixel moves towards a quadric
/// through its neighbourhood, by as much as its own standard error says against the patch's, which
/// holds how far the neighbours lie off it beyond their noise: relief that was really measured
/// stays (docs/stereo.md, §6). Both rasters change; what is NaN stays NaN. `refinement` made the
/// map: pixels within one of its windows err alike, and no neighbour removes its `model_sigma_px`.
void smoothByPatches(const SmoothingOptions& options, const RefinementOptions& refinement,
                     DisparityMap& map);

}  // namespace softscope
