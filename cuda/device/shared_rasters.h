// cuda/device/shared_rasters.h: rasters of the frame at hand that lie on the device already.
#pragma once

#include <Eigen/Core>

#include "core/image.h"
#include "fusion/observation.h"

namespace softscope::cuda {

/// Known by their place in the host's memory. Whoever copies them sets this once they are there,
/// and clears it before that memory changes; no stage may look at the same time.
struct SharedRasters {
  const float* host_depth_mm = nullptr;
  const float *depth_mm = nullptr, *sigma_mm = nullptr;  // on the device; without sigmas null
  const Eigen::Vector3f* normals = nullptr;
  const PixelState* states = nullptr;
  const Rgb8* colour = nullptr;                                 // null without
  const std::uint8_t *match_gray = nullptr, *ignore = nullptr;  // as it is matched; null: nothing

  bool holds(const float* depth) const { return depth != nullptr && depth == host_depth_mm; }
};

/// Rasters of the frames on the device.
struct SharedFrames {
  SharedRasters measured;  // where stereo left it
  SharedRasters next;      // surveyed, not used yet
  SharedRasters at_hand;
};

}  // namespace softscope::cuda
