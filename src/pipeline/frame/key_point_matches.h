// src/pipeline/frame/key_point_matches.h: matches of the frame as constraints of the warp.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "deform/energy/constraints.h"
#include "deform/options/deform_options.h"
#include "features/lift_matches.h"
#include "pose/ransac_pose.h"

namespace softscope {

/// In the order of `lifted`, without wrong and too distant matches. `pose`: of estimateRigidPose()
/// over them; none where it found no pose, as it is not known then which are wrong.
std::vector<KeyPointMatch> keyPointMatches(const std::vector<LiftedMatch>& lifted,
                                           const RigidPose& pose,
                                           const AssociationOptions& association,
                                           const Eigen::Isometry3d& world_from_left);

}  // namespace softscope
