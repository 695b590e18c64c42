// src/core/camera.h: pinhole camera: projection of points in mm to pixels, and back-projection.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/hd.h"

namespace softscope {

/// Camera without distortion. Camera frame: x right, y down, z forward, mm.
struct PinholeCamera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;

  Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d k;
    k << fx_px, 0, cx_px, 0, fy_px, cy_px, 0, 0, 1;
    return k;
  }
};

/// Pixel (u, v) of a point in the camera frame. Requires z > 0.
template <class Scalar>
SOFTSCOPE_HD inline Eigen::Matrix<Scalar, 2, 1> projectPoint(
    const PinholeCamera& camera, const Eigen::Matrix<Scalar, 3, 1>& point_mm) {
  const Scalar inverse_z = Scalar(1) / point_mm.z();
  return {Scalar(camera.fx_px) * point_mm.x() * inverse_z + Scalar(camera.cx_px),
          Scalar(camera.fy_px) * point_mm.y() * inverse_z + Scalar(camera.cy_px)};
}

/// Point in the camera frame, mm, of pixel (u, v) at `depth_mm` along the optical axis.
template <class Scalar>
SOFTSCOPE_HD inline Eigen::Matrix<Scalar, 3, 1> liftPixel(const PinholeCamera& camera, Scalar u_px,
                                                          Scalar v_px, Scalar depth_mm) {
  return {(u_px - Scalar(camera.cx_px)) / Scalar(camera.fx_px) * depth_mm,
          (v_px - Scalar(camera.cy_px)) / Scalar(camera.fy_px) * depth_mm, depth_mm};
}

/// Lens distortion in OpenCV's model and order k1 k2 p1 p2 k3 k4 k5 k6
/// s1 s2 s3 s4 (rational, tangential, thin prism). Zero = no distortion.
struct LensDistortion {
  std::array<double, 12> coefficients{};

  bool isZero() const {
    for (const double c : coefficients)
      if (c != 0) return false;
    return true;
  }
};

/// Calibrated camera before rectification.
struct RawCamera {
  PinholeCamera pinhole;
  LensDistortion distortion;
};

}  // namespace softscope
