// src/pipeline/tracks/track_sight.h: visibility of tracked points in a frame, and position errors.
#pragma once

#include <vector>

#include "core/rectified_rig.h"
#include "features/nearest_depth.h"
#include "pipeline/frame/frame_view.h"
#include "pipeline/tracks/material_points.h"

namespace softscope {

/// Points are in the left camera frame, mm. The frame and the rig must outlive it.
class TrackSight {
 public:
  TrackSight(const FrameView& frame, const RectifiedRig& rig) : frame_(frame), rig_(rig) {}

  /// Whether the image shows the point;
  /// unmeasured depth occludes nothing.
  bool shows(const Eigen::Vector3d& point_left) const {
    return shows(point_left, surfaceAt(point_left, 0));
  }
  /// Visible: shown by the image with measured depth or, in a gap, next to it,
  /// with a predicted error, without relief, of at most the largest sigma of a used depth.
  /// `relief_px`: reliefErrorPx() of the frame; without sigmas it is not used.
  std::vector<TrackedPosition> positions(const MaterialPoints& tracked,
                                         const Eigen::Isometry3d& world_from_left,
                                         const Raster<float>& relief_px) const;

 private:
  /// Measured depth at the pixel of the point or within `gap_px`.
  NearestDepth surfaceAt(const Eigen::Vector3d& point_left, int gap_px) const;
  bool shows(const Eigen::Vector3d& point_left, const NearestDepth& surface) const;

  const FrameView& frame_;
  const RectifiedRig& rig_;
};

}  // namespace softscope
