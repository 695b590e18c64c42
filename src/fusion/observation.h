// src/fusion/observation.h: depth, colours and pose of one frame, and states of pixels.
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

/// Data of one frame in the rectified left camera. The rasters are owned by the caller, must
/// outlive this, and have the size of the camera; depth.sigma_mm, colour and mask may be empty.
struct Observation {
  const DepthMap& depth;
  const NormalMap& normals;
  const ColourImage& colour;
  const Mask& mask;
  PinholeCamera left;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();

  /// Throws OptionError for a size that differs from the camera,
  /// a camera without focal length, or a pose that is not finite.
  void validate() const;
};

/// In single precision.
PosedCamera posedCamera(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left);

/// State of a pixel.
enum class PixelState : std::uint8_t {
  kUnmeasured,  // no depth
  kMasked,      // not tissue
  kEdge,        // near a depth discontinuity
  kRejected,    // sigma too large, no normal, or too grazing
  kAccepted,
};

/// Classifies every pixel. Size of the camera.
Raster<PixelState> classifyPixels(const Observation& observation, const PixelOptions& options);

}  // namespace softscope
