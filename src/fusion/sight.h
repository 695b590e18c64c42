// src/fusion/sight.h: visibility of one model point: docs/fusion.md (F1) to (F3).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/hd.h"

namespace softscope {

enum class Sight : std::uint8_t {
  kOutside,      // not in the image
  kUnknown,      // in the image, without an accepted measurement
  kMasked,       // behind an instrument, or outside of the circular image
  kHidden,       // behind the measured surface, or a nearer one of the model
  kTurned,       // at the measured surface, with a different normal
  kSeen,         // visible
  kSeenThrough,  // free-space violation: the point is obsolete
};

/// Comparison of a point with the measurement. 12 bytes.
struct PointSight {
  float ahead_mm = std::numeric_limits<float>::quiet_NaN();  // measured minus own depth, along
                                                             // the ray; NaN without a measurement
  std::int32_t pixel = -1;                                   // index into the rasters; -1 = none
  Sight sight = Sight::kOutside;
};

/// Thresholds of (F3) for the inner loops.
struct SightLimits {
  float distance_mm = 0;
  float cosine = 0;
};

/// Depth at which the point's own ray meets the plane measured at the pixel: (F1). `lifted_left` is
/// the pixel's measured point, `normal_left` its normal. NaN where the ray misses the plane.
SOFTSCOPE_HD inline float measuredDepth(const Eigen::Vector3f& point_left,
                                        const Eigen::Vector3f& lifted_left,
                                        const Eigen::Vector3f& normal_left) {
  const float towards = -normal_left.dot(point_left);
  if (!(towards > 0)) return std::numeric_limits<float>::quiet_NaN();
  return -normal_left.dot(lifted_left) * (point_left.z() / towards);
}

/// Length of a ray per mm of depth.
SOFTSCOPE_HD inline float rayStretch(const Eigen::Vector3f& point_left) {
  const float x = point_left.x() / point_left.z(), y = point_left.y() / point_left.z();
  return std::sqrt(x * x + y * y + 1);
}

/// (F3), for a point in the image and an accepted pixel.
SOFTSCOPE_HD inline PointSight compareWithPixel(const Eigen::Vector3f& point_left,
                                                const Eigen::Vector3f& own_normal_left,
                                                const Eigen::Vector3f& lifted_left,
                                                const Eigen::Vector3f& normal_left,
                                                const SightLimits& limits) {
  PointSight result;
  const float depth_mm = measuredDepth(point_left, lifted_left, normal_left);
  result.ahead_mm = (depth_mm - point_left.z()) * rayStretch(point_left);
  if (result.ahead_mm >= limits.distance_mm)
    result.sight = Sight::kSeenThrough;
  else if (result.ahead_mm <= -limits.distance_mm)
    result.sight = Sight::kHidden;
  else if (result.ahead_mm > -limits.distance_mm &&  // not NaN
           own_normal_left.dot(normal_left) > limits.cosine)
    result.sight = Sight::kSeen;
  else
    result.sight = Sight::kTurned;
  return result;
}

}  // namespace softscope
