// src/deform/surface_target.h: where the live surface wants a warped model point to be.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/camera.h"
#include "core/depth_map.h"
#include "deform/deform_options.h"

namespace softscope {

/// A piece of the live surface, world frame.
struct PlaneTarget {
  Eigen::Vector3f point_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float reliability = 0;  // weighs the squared residual; 0: the surface says nothing here
};

/// The live surface, however it was measured.
class SurfaceTarget {
 public:
  virtual ~SurfaceTarget() = default;
  /// The planes for `count` warped points (world frame, mm) and their normals, which are neighbours
  /// on the model. Called from several threads.
  virtual void lookUp(const Eigen::Vector3f* points_mm, const Eigen::Vector3f* normals, int count,
                      PlaneTarget* targets) const = 0;
};

/// Projective association with a depth map: docs/energy.md (8) to (11). The map and the normals
/// are the caller's and must outlive this.
class DepthTarget : public SurfaceTarget {
 public:
  /// Throws OptionError where the shapes of depth, normals and camera differ.
  /// depth.sigma_mm may be empty: then every depth is as good as the reference.
  DepthTarget(const DepthMap& depth, const NormalMap& normals, const PinholeCamera& left,
              const Eigen::Isometry3d& left_from_world, const AssociationOptions& options);

  void lookUp(const Eigen::Vector3f* points_mm, const Eigen::Vector3f* normals, int count,
              PlaneTarget* targets) const override;

 private:
  Eigen::Vector3f toLeft(const Eigen::Vector3f& point_mm) const {
    return left_from_world_rotation_ * point_mm + left_from_world_translation_mm_;
  }
  int pixelOf(const Eigen::Vector3f& point_left) const;
  PlaneTarget targetAt(int pixel, const Eigen::Vector3f& point_left,
                       const Eigen::Vector3f& normal) const;
  float reliabilityAt(int pixel, const Eigen::Vector3f& lifted_left,
                      const Eigen::Vector3f& normal_left) const;

  const DepthMap& depth_;
  const NormalMap& normals_;
  int width_px_, height_px_;
  float fx_px_, fy_px_, cx_px_, cy_px_;
  Eigen::Matrix3f left_from_world_rotation_;
  Eigen::Vector3f left_from_world_translation_mm_;
  float squared_distance_limit_;
  float cosine_limit_;
  bool use_sigma_;
  float reference_sigma_mm_;
  float max_reliability_;
};

}  // namespace softscope
