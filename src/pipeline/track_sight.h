// src/pipeline/track_sight.h: which tracked points a frame shows, and how sure their places are.
#pragma once

#include <vector>

#include "core/rectified_rig.h"
#include "pipeline/frame_view.h"
#include "pipeline/material_points.h"
#include "pipeline/nearest_depth.h"

namespace softscope {

/// Points are in the left camera's frame, mm. The frame and the rig must outlive it.
class TrackSight {
 public:
  TrackSight(const FrameView& frame, const RectifiedRig& rig) : frame_(frame), rig_(rig) {}

  /// Whether the image shows the point, as far as is known: where no depth was measured, nothing
  /// hides it.
  bool shows(const Eigen::Vector3d& point_left) const {
    return shows(point_left, surfaceAt(point_left, 0));
  }
  /// Visible is what the image shows where depth was measured or, in a gap, beside it.
  std::vector<TrackedPosition> positions(const MaterialPoints& tracked,
                                         const Eigen::Isometry3d& world_from_left) const;

 private:
  /// Measured depth at the point's pixel or within so many pixels.
  NearestDepth surfaceAt(const Eigen::Vector3d& point_left, int gap_px) const;
  bool shows(const Eigen::Vector3d& point_left, const NearestDepth& surface) const;

  const FrameView& frame_;
  const RectifiedRig& rig_;
};

}  // namespace softscope
