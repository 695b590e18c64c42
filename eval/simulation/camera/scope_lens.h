// eval/simulation/camera/scope_lens.h: projection with lens distortion, and its inverse.
#pragma once

#include "core/camera.h"

namespace softscope {

/// OpenCV model with the first five coefficients k1 k2 p1 p2 k3; all zero: pinhole.
struct ScopeLens {
  PinholeCamera camera;
  LensDistortion distortion;

  /// Pixel of a point in the camera frame, z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& point_mm) const;
  /// Viewing ray of a pixel, z = 1, in the camera frame: inverse of project() by Newton steps.
  Eigen::Vector3d ray(double u_px, double v_px) const;
  /// True if the projection is injective in the image and a margin around it.
  bool invertible() const;
};

}  // namespace softscope
