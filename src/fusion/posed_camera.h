// src/fusion/posed_camera.h: projection from the world to pixels in single precision.
#pragma once

#include <Eigen/Core>

#include "core/hd.h"

namespace softscope {

/// Lens and pose in single precision, for the inner loops.
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
  /// Pixel of the point; false outside of the image, also for NaN.
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
  /// Ray of the pixel at depth 1.
  SOFTSCOPE_HD Eigen::Vector3f ray(int u, int v) const {
    return {(static_cast<float>(u) - cx_px) / fx_px, (static_cast<float>(v) - cy_px) / fy_px, 1};
  }
};

}  // namespace softscope
