// src/fusion/observation.h: what the scope measured just now, and which pixels may be believed.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "core/camera.h"
#include "core/depth_map.h"
#include "core/hd.h"
#include "core/image.h"
#include "fusion/fusion_options.h"

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

/// Lens and pose in single precision, as the inner loops want them.
struct PosedCamera {
  Eigen::Matrix3f left_from_world = Eigen::Matrix3f::Identity();
  Eigen::Vector3f left_from_world_mm = Eigen::Vector3f::Zero();
  float fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  int width_px = 0, height_px = 0;

  /// World to left camera, mm.
  SOFTSCOPE_HD Eigen::Vector3f toLeft(const Eigen::Vector3f& point_world) const {
    return left_from_world * point_world + left_from_world_mm;
  }
  /// Left camera to world, mm.
  SOFTSCOPE_HD Eigen::Vector3f toWorld(const Eigen::Vector3f& point_left) const {
    return left_from_world.transpose() * (point_left - left_from_world_mm);
  }
  /// The pixel that holds the point's picture; false where it is not in the picture, NaN included.
  SOFTSCOPE_HD bool findPixel(const Eigen::Vector3f& point_left, int* u, int* v) const {
    if (!(point_left.z() > 0)) return false;
    const float inverse_z = 1 / point_left.z();
    const float column = fx_px * point_left.x() * inverse_z + cx_px + 0.5f;
    const float row = fy_px * point_left.y() * inverse_z + cy_px + 0.5f;
    if (!(column >= 0 && row >= 0 && column < static_cast<float>(width_px) &&
          row < static_cast<float>(height_px)))
      return false;
    *u = static_cast<int>(column);
    *v = static_cast<int>(row);
    return true;
  }
  /// What the pixel sees at depth 1.
  SOFTSCOPE_HD Eigen::Vector3f ray(int u, int v) const {
    return {(static_cast<float>(u) - cx_px) / fx_px, (static_cast<float>(v) - cy_px) / fy_px, 1};
  }
};

PosedCamera posedCamera(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left);

/// What a pixel has to say about the surface.
enum class PixelState : std::uint8_t {
  kUnmeasured,  // no depth
  kMasked,      // not tissue
  kEdge,        // too near to a depth edge
  kUnsure,      // depth not sure enough, no normal, or too grazing
  kSure,
};

/// Judges every pixel. Shape: the camera's.
Raster<PixelState> judgePixels(const Observation& observation, const PixelOptions& options);

}  // namespace softscope
