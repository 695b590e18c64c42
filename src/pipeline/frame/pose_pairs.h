// src/pipeline/frame/pose_pairs.h: lifted matches as the pairs of the two searches for the pose.
#pragma once

#include <vector>

#include "core/point_model.h"
#include "core/stereo_rig.h"
#include "core/warp_graph.h"
#include "features/lift_matches.h"
#include "pose/ransac_pose.h"
#include "pose/refine_pose.h"

namespace softscope {

/// From the live camera's frame to the world, weighted by their inverse variances.
PointPairs posePairs(const std::vector<LiftedMatch>& matches);

/// For refinePose(): an even subset of the matches, of which the inliers of `pose`. Errors of
/// neighbouring matches correlate, so it carries as much information as all of them.
std::vector<PosePair> refinementPairs(const std::vector<LiftedMatch>& matches,
                                      const RigidPose& pose, const PointModel& model,
                                      const WarpGraph& graph, const RectifiedRig& rig);

}  // namespace softscope
