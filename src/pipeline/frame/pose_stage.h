// src/pipeline/frame/pose_stage.h: stage 4, the scope's pose from the lifted matches of a frame.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <utility>
#include <vector>

#include "core/point_model.h"
#include "core/stereo_rig.h"
#include "core/warp_graph.h"
#include "features/lift_matches.h"
#include "pipeline/frame/pose_summary.h"
#include "pose/ransac_pose.h"
#include "pose/refine_pose.h"

namespace softscope {

/// As in ReconstructionBackend::locate().
struct EarlierPoses {
  const Eigen::Isometry3d &last, &reference;
  ScopeBefore before;
};

/// RANSAC, then the refinement, as options tell.
class PoseStage {
 public:
  /// `rig` outlives the stage.
  PoseStage(const RectifiedRig& rig, const RefinePoseOptions& options,
            std::unique_ptr<PoseSearch> search)
      : rig_(rig), options_(options), search_(std::move(search)) {}

  PoseSummary estimate(const std::vector<LiftedMatch>& matches, const RansacOptions& ransac,
                       const PointModel& model, const WarpGraph& graph,
                       const EarlierPoses& earlier);
  /// Of the last frame: by RANSAC, with its inliers.
  const RigidPose& rigid() const { return rigid_; }
  void forget() { rigid_ = RigidPose(); }

 private:
  const RectifiedRig& rig_;
  RefinePoseOptions options_;
  std::unique_ptr<PoseSearch> search_;
  RigidPose rigid_;
};

}  // namespace softscope
