// eval/simulation/camera/scope_lens.h: projection with lens distortion, and its inverse.
#pragma once

#include "core/camera.h"

namespace softscope {

/// OpenCV's model with its first five coefficients k1 k2 p1 p2 k3; all zero: a pinhole.
struct ScopeLens {
  PinholeCamera camera;
  LensDistortion distortion;

  /// Pixel of a point in the camera's frame, z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& point_mm) const;
  /// What the pixel looks along, z = 1, in the camera's frame: project()'s inverse by Newton steps.
  Eigen::Vector3d ray(double u_px, double v_px) const;
  /// Whether no two directions meet in one pixel, in the image and a little around it.
  bool invertible() const;
};

}  // namespace softscope
