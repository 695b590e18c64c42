// src/pipeline/frame/relocaliser.h: relocalisation: scope pose from surface patches.
#pragma once

#include <vector>

#include "features/matcher.h"
#include "features/model_view.h"
#include "features/surface_patches.h"
#include "pipeline/frame/frame_depth.h"
#include "pose/ransac_pose.h"

namespace softscope {

/// Pose of the live left camera in the world (mm), from similar surface patches in the
/// live image and in views of the model from `viewpoints` (world_from_left): the rigid
/// motion with the most inliers. On small images, whose pixels show large structures;
/// without deformation. `found` is false if no viewpoint has enough inliers.
RigidPose relocalise(const PointModel& model, const std::vector<Eigen::Isometry3d>& viewpoints,
                     const MatchPicture& live, const MeasuredFrame& frame,
                     const PinholeCamera& camera, const ModelViewOptions& view_options,
                     const RansacOptions& ransac);

}  // namespace softscope
