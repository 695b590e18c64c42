#include "pipeline/frame/pose_stage.h"

#include "pipeline/frame/pose_pairs.h"

namespace softscope {

PoseSummary PoseStage::estimate(const std::vector<LiftedMatch>& matches,
                                const RansacOptions& ransac, const PointModel& model,
                                const WarpGraph& graph, const EarlierPoses& earlier) {
  rigid_ = estimateRigidPose(posePairs(matches), ransac);
  PoseSummary summary;
  summary.found = rigid_.found;
  summary.failure = rigid_.failure;
  if (!rigid_.found) return summary;
  summary.world_from_left = rigid_.target_from_source;
  summary.inliers = rigid_.inliers;
  summary.rms_mm = rigid_.rms_mm;
  if (options_.iterations == 0) return summary;
  const RefinedPose best = refinePose(refinementPairs(matches, rigid_, model, graph, rig_), rig_,
                                      rigid_.target_from_source, earlier.last, earlier.reference,
                                      earlier.before, options_, search_.get());
  summary.world_from_left = best.world_from_left;
  summary.scope_static = best.scope_static;
  summary.keeps_shape = best.keeps_shape;
  summary.moved_mm = best.moved_mm;
  summary.sigma_mm = best.sigma_mm;
  summary.sigma_deg = best.sigma_deg;
  return summary;
}

}  // namespace softscope
