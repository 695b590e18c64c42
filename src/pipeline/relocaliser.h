// src/pipeline/relocaliser.h: relocalisation: scope pose from surface patches.
#pragma once

#include <vector>

#include "features/matcher.h"
#include "features/model_view.h"
#include "features/surface_patches.h"
#include "pipeline/frame_depth.h"
#include "pose/ransac_pose.h"

namespace softscope {

/// Where the live left camera is in the world (mm), by surface patches that look alike in the live
/// image and in views of the model from `viewpoints` (world_from_left): the rigid motion with the
/// most inliers. Made on small images, whose pixels are those of large structures; no deformation
/// is sought. `found` is false where no viewpoint has enough.
RigidPose relocalise(const PointModel& model, const std::vector<Eigen::Isometry3d>& viewpoints,
                     const MatchPicture& live, const MeasuredFrame& frame,
                     const PinholeCamera& camera, const ModelViewOptions& view_options,
                     const RansacOptions& ransac);

}  // namespace softscope
