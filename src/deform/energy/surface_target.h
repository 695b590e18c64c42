// src/deform/energy/surface_target.h: target plane of each warped model point.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/camera.h"
#include "core/depth_map.h"
#include "deform/kernels/depth_look_up.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Live surface from any measurement.
class SurfaceTarget {
 public:
  virtual ~SurfaceTarget() = default;
  /// Target planes of `count` warped points (world frame, mm) with their
  /// normals, which are neighbours on the model. Called from several threads.
  virtual void lookUp(const Eigen::Vector3f* points_mm, const Eigen::Vector3f* normals, int count,
                      PlaneTarget* targets) const = 0;
};

/// Projective association with a depth map: docs/energy.md (8) to (11).
/// Map and normals are owned by the caller and must outlive this.
class DepthTarget : public SurfaceTarget {
 public:
  /// Throws OptionError for inconsistent sizes of depth, normals and camera.
  /// depth.sigma_mm may be empty: then every depth has the reference sigma.
  DepthTarget(const DepthMap& depth, const NormalMap& normals, const PinholeCamera& left,
              const Eigen::Isometry3d& left_from_world, const AssociationOptions& options);

  void lookUp(const Eigen::Vector3f* points_mm, const Eigen::Vector3f* normals, int count,
              PlaneTarget* targets) const override;

  /// Valid while depth and normals are.
  const DepthLookUp& formula() const { return look_up_; }

 private:
  DepthLookUp look_up_;
};

}  // namespace softscope
