// src/fusion/view_evidence.h: agreement of the warped, rendered model with the frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hd.h"
#include "fusion/correlation_blocks.h"
#include "fusion/drawn_points.h"
#include "fusion/observation.h"

namespace softscope {

/// Evidence for pose and warp that is independent of the matches: docs/fusion.md (F25), (F26).
struct ViewEvidence {
  // NaN where nothing could be compared.
  double depth_share = std::numeric_limits<double>::quiet_NaN();  // of pixels whose depth agrees
  double image_share = std::numeric_limits<double>::quiet_NaN();  // of image blocks that correlate
                                                                  // best where the model puts them
  int blocks = 0;                                                 // with texture

  /// 0: agreement as by chance, 1: everywhere. 0 without comparable pixels.
  double agreement() const;
};

/// Whether the depth of the model agrees with the measured one. `sigma_mm` 0 if unknown.
SOFTSCOPE_HD inline bool depthsAgree(float model_mm, float measured_mm, float sigma_mm,
                                     float depth_step) {
  constexpr float kSigmas = 3;
  const float by_step_mm = depth_step * measured_mm, by_sigma_mm = kSigmas * sigma_mm;
  const float tolerance_mm = by_step_mm < by_sigma_mm ? by_sigma_mm : by_step_mm;
  return std::abs(model_mm - measured_mm) <= tolerance_mm;
}

/// Shift of blocks for an image of that width: 8 px of 640.
inline int evidenceShiftPx(int width_px) { return std::max(3, width_px / 80); }

/// Of the sums over an image.
ViewEvidence evidenceOf(int compared_px, int agreeing_px, CorrelationBlocks blocks);

/// For the model rendered from the pose of the observation: compares, over the accepted
/// pixels, its depth, to `options.kEdgeStep` of the depth or three standard errors,
/// whichever is larger; and the brightness of its points with the image, per block, in
/// place and moved in eight directions. Throws OptionError for inconsistent arguments.
ViewEvidence viewEvidence(const DrawnPoints& drawn, const Observation& observation,
                          const Raster<PixelState>& states, const PixelOptions& options);

}  // namespace softscope
