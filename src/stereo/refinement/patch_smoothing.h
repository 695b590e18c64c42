// src/stereo/refinement/patch_smoothing.h: smoothing of disparity by quadric patches of the
// neighbourhood.
#pragma once

#include "core/depth_map.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Tissue is smooth over a few millimetres, noise is not. Every pixel moves towards a quadric
/// through its neighbourhood, by the ratio of its standard error to that of the patch, which
/// includes the distance of the neighbours from it beyond their noise: measured relief stays
/// (docs/stereo.md, §6). Both rasters change; NaN stays NaN. `refinement` made the map: errors of
/// pixels within one of its windows are correlated, and no neighbour reduces its `model_sigma_px`.
void smoothByPatches(const SmoothingOptions& options, const RefinementOptions& refinement,
                     DisparityMap& map);

}  // namespace softscope
