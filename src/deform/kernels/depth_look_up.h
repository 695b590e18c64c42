// src/deform/kernels/depth_look_up.h: target plane of one warped point in a depth map, for CPU and
// GPU.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/hd.h"

namespace softscope {

/// Plane of the live surface, world frame.
struct PlaneTarget {
  Eigen::Vector3f point_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float reliability = 0;  // weight of the squared residual; 0: no target here
};

/// Projective association with a depth map: docs/energy.md (8) to (11). Non-owning.
struct DepthLookUp {
  const float* depth_mm = nullptr;           // NaN: not measured
  const Eigen::Vector3f* normals = nullptr;  // left camera frame; NaN: none
  const float* sigma_mm = nullptr;           // read where use_sigma
  int width_px = 0, height_px = 0;
  float fx_px = 1, fy_px = 1, cx_px = 0, cy_px = 0;
  Eigen::Matrix3f left_from_world_rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f left_from_world_translation_mm = Eigen::Vector3f::Zero();
  float squared_distance_limit = 0;
  float cosine_limit = 0;
  bool use_sigma = false;
  float reference_sigma_mm = 0;
  float max_reliability = 0;

  SOFTSCOPE_HD Eigen::Vector3f toLeft(const Eigen::Vector3f& point_mm) const {
    return left_from_world_rotation * point_mm + left_from_world_translation_mm;
  }

  /// Pixel of the point; -1 outside of the image or behind the camera.
  SOFTSCOPE_HD int pixelOf(const Eigen::Vector3f& point_left) const {
    if (!(point_left.z() > 0)) return -1;
    const float inverse_z = 1 / point_left.z();
    const float u = fx_px * point_left.x() * inverse_z + cx_px + 0.5f;
    const float v = fy_px * point_left.y() * inverse_z + cy_px + 0.5f;
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(width_px) &&
          v < static_cast<float>(height_px)))
      return -1;
    return static_cast<int>(v) * width_px + static_cast<int>(u);
  }

  /// For a pixel of the image and a unit normal of the point, world frame.
  SOFTSCOPE_HD PlaneTarget targetAt(int pixel, const Eigen::Vector3f& point_left,
                                    const Eigen::Vector3f& normal) const {
    PlaneTarget target;
    const float depth = depth_mm[pixel];
    if (!(depth > 0)) return target;  // NaN = unmeasured
    const int row = pixel / width_px, column = pixel - row * width_px;
    const Eigen::Vector3f lifted((static_cast<float>(column) - cx_px) / fx_px * depth,
                                 (static_cast<float>(row) - cy_px) / fy_px * depth, depth);
    if (!((lifted - point_left).squaredNorm() < squared_distance_limit)) return target;
    const Eigen::Vector3f& normal_left = normals[pixel];
    const auto world_from_left = left_from_world_rotation.transpose();
    target.normal = world_from_left * normal_left;
    if (!(normal.dot(target.normal) > cosine_limit)) return target;  // no normal: NaN
    target.point_mm = world_from_left * (lifted - left_from_world_translation_mm);
    target.reliability = reliabilityAt(pixel, lifted, normal_left);
    return target;
  }

 private:
  /// docs/energy.md (11): a depth error moves the target along its ray, so its
  /// effect across the plane is scaled by the cosine between ray and normal.
  SOFTSCOPE_HD float reliabilityAt(int pixel, const Eigen::Vector3f& lifted_left,
                                   const Eigen::Vector3f& normal_left) const {
    if (!use_sigma) return 1;
    const float sigma = sigma_mm[pixel];
    if (!(sigma > 0)) return 0;  // NaN too: no valid sigma
    const float across = std::abs(normal_left.dot(lifted_left)) / lifted_left.z() * sigma;
    const float ratio = reference_sigma_mm / (across < 1e-6f ? 1e-6f : across);
    return max_reliability < ratio * ratio ? max_reliability : ratio * ratio;
  }
};

}  // namespace softscope
