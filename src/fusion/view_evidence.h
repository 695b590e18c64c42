// src/fusion/view_evidence.h: whether the warped model, seen from the pose, shows the frame.
#pragma once

#include <limits>

#include "fusion/drawn_points.h"
#include "fusion/observation.h"

namespace softscope {

/// Evidence for a pose and a warp that no match has gone into: docs/fusion.md (F25), (F26).
struct ViewEvidence {
  // NaN where nothing could be compared.
  double depth_share = std::numeric_limits<double>::quiet_NaN();  // of pixels whose depth agrees
  double image_share = std::numeric_limits<double>::quiet_NaN();  // of image blocks that correlate
                                                                  // best where the model puts them
  int blocks = 0;                                                 // that have texture

  /// 0: no more agreement than by chance, 1: everywhere. 0 where nothing could be compared.
  double confidence() const;
};

/// Of the model drawn from the observation's pose: compares, over the pixels that are sure: its
/// depth, to `options.kEdgeStep` of the depth or three standard errors, whichever is more; and the
/// brightness of its points with the image, block by block, in place and moved by some pixels in
/// eight directions. Throws OptionError where the arguments don't fit together.
ViewEvidence viewEvidence(const DrawnPoints& drawn, const Observation& observation,
                          const Raster<PixelState>& states, const PixelOptions& options);

}  // namespace softscope
