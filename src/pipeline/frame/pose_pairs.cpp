#include "pipeline/frame/pose_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "deform/graph/warp.h"

namespace softscope {
namespace {

constexpr std::size_t kMostPairs = 1500;  // for the refinement
constexpr int kPairsPerTask = 256;

PosePair refinementPair(const LiftedMatch& match, const PointModel& model, const WarpGraph& graph,
                        const RectifiedRig& rig) {
  const Eigen::Vector3d live = match.target_left_mm.cast<double>();
  const double px_per_mm = rig.left.fx_px / live.z();
  const double sigma_mm = std::isfinite(match.along_mm) ? match.along_mm : 0;
  const PointBinding& binding = model.bindings[static_cast<std::size_t>(match.model_point)];
  const Eigen::Vector3d model_mm = match.source_world_mm.cast<double>();
  return {model_mm,
          referencePosition(graph, binding, model_mm),
          projectPoint(rig.left, live),
          match.across_mm * px_per_mm,
          rig.disparityPx(live.z()),
          sigma_mm * px_per_mm * rig.baseline_mm / live.z()};
}

}  // namespace

PointPairs posePairs(const std::vector<LiftedMatch>& matches) {
  PointPairs pairs;
  pairs.sources_mm.resize(matches.size());
  pairs.targets_mm.resize(matches.size());
  pairs.weights.resize(matches.size());
  parallelRanges(static_cast<int>(matches.size()), 4 * kPairsPerTask, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const LiftedMatch& match = matches[i];
      pairs.sources_mm[i] = match.target_left_mm;
      pairs.targets_mm[i] = match.source_world_mm;
      const float along = std::isfinite(match.along_mm) ? match.along_mm : match.across_mm;
      const float variance = (2 * match.across_mm * match.across_mm + along * along) / 3;
      pairs.weights[i] = 1 / std::max(variance, 1e-6f);
    }
  });
  return pairs;
}

std::vector<PosePair> refinementPairs(const std::vector<LiftedMatch>& matches,
                                      const RigidPose& pose, const PointModel& model,
                                      const WarpGraph& graph, const RectifiedRig& rig) {
  std::vector<std::size_t> chosen;
  const std::size_t step = 1 + matches.size() / kMostPairs;
  for (std::size_t i = 0; i < matches.size(); i += step)
    if (pose.inlier[i] != 0) chosen.push_back(i);
  std::vector<PosePair> pairs(chosen.size());
  parallelRanges(static_cast<int>(chosen.size()), kPairsPerTask, [&](int begin, int end) {
    for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      pairs[k] = refinementPair(matches[chosen[k]], model, graph, rig);
  });
  return pairs;
}

}  // namespace softscope
