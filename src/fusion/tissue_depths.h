// src/fusion/tissue_depths.h: numbers and medians of the depths of a frame.
#pragma once

#include <limits>

#include "core/depth_map.h"
#include "core/image.h"

namespace softscope {

/// Of the pixels of tissue.
struct TissueDepths {
  int tissue_px = 0;
  int measured_px = 0;
  int precise_px = 0;  // sigma at most kPreciseSigmaMm
  // The upper one for an even number; NaN without measured pixels, or without sigmas.
  double median_mm = std::numeric_limits<double>::quiet_NaN();
  double median_sigma_mm = std::numeric_limits<double>::quiet_NaN();
};

/// `not_tissue` has the shape of the depths; sigmas may be empty.
TissueDepths tissueDepths(const DepthMap& depth, const Mask& not_tissue);

}  // namespace softscope
