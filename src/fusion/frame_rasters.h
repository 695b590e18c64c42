// src/fusion/frame_rasters.h: depth, normals and colours of one frame as pointers.
#pragma once

#include <Eigen/Core>

#include "core/image.h"
#include "fusion/observation.h"

namespace softscope {

/// Rasters of an observation, in memory of the CPU or the GPU; non-owning.
struct FrameRasters {
  const float* depth_mm = nullptr;
  const float* sigma_mm = nullptr;  // null: depths without sigma
  const Eigen::Vector3f* normals = nullptr;
  const Rgb8* colour = nullptr;  // null: no image
};

inline FrameRasters frameRasters(const Observation& observation) {
  const DepthMap& depth = observation.depth;
  return {depth.depth_mm.values.data(),
          depth.sigma_mm.empty() ? nullptr : depth.sigma_mm.values.data(),
          observation.normals.values.data(),
          observation.colour.empty() ? nullptr : observation.colour.values.data()};
}

}  // namespace softscope
