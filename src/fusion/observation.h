// src/fusion/observation.h: depth, colours and pose of one frame, and the state of each pixel.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "core/camera.h"
#include "core/depth_map.h"
#include "core/image.h"
#include "fusion/fusion_options.h"
#include "fusion/posed_camera.h"

namespace softscope {

/// One moment, seen from the rectified left camera. The rasters are the caller's, must outlive
/// this, and have the camera's shape; depth.sigma_mm, colour and mask may be empty.
struct Observation {
  const DepthMap& depth;
  const NormalMap& normals;
  const ColourImage& colour;
  const Mask& mask;
  PinholeCamera left;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();

  /// Throws OptionError where a shape differs from the camera's, the camera has no focal length,
  /// or the pose isn't finite.
  void validate() const;
};

/// In single precision.
PosedCamera posedCamera(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left);

/// State of a pixel.
enum class PixelState : std::uint8_t {
  kUnmeasured,  // no depth
  kMasked,      // not tissue
  kEdge,        // too near to a depth edge
  kUnsure,      // sigma too large, no normal, or too grazing
  kSure,
};

/// Judges every pixel. Shape: the camera's.
Raster<PixelState> judgePixels(const Observation& observation, const PixelOptions& options);

}  // namespace softscope
