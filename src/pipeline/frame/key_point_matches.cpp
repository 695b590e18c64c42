#include "pipeline/frame/key_point_matches.h"

#include <cmath>
#include <optional>

#include "core/parallel.h"

namespace softscope {
namespace {

/// None where the match is an outlier of the pose whose windows differ, or longer than the gate.
std::optional<KeyPointMatch> keyPointMatch(const LiftedMatch& match, bool is_outlier,
                                           const AssociationOptions& association,
                                           const Eigen::Isometry3d& world_from_left) {
  // Outliers whose windows agree are moving tissue; the others are wrong matches.
  if (is_outlier && !(match.similarity > 0)) return std::nullopt;
  KeyPointMatch pull;
  pull.model_point = match.model_point;
  pull.source_mm = match.source_world_mm;
  pull.target_mm = (world_from_left * match.target_left_mm.cast<double>()).cast<float>();
  if ((pull.target_mm - pull.source_mm).norm() > association.max_distance_mm) return std::nullopt;
  const double reference_mm = association.reference_sigma_mm;
  if (std::isfinite(match.along_mm) && reference_mm > 0) {
    const Eigen::Vector3f ray =
        (world_from_left.linear() * match.target_left_mm.cast<double>().normalized()).cast<float>();
    pull.sqrt_information =
        matchSqrtInformation(ray, match.along_mm, match.across_mm, reference_mm);
  }
  return pull;
}

}  // namespace

std::vector<KeyPointMatch> keyPointMatches(const std::vector<LiftedMatch>& lifted,
                                           const RigidPose& pose,
                                           const AssociationOptions& association,
                                           const Eigen::Isometry3d& world_from_left) {
  if (!pose.found) return {};
  std::vector<std::optional<KeyPointMatch>> pulls(lifted.size());
  parallelRanges(static_cast<int>(lifted.size()), kMatchesPerTask, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      pulls[i] = keyPointMatch(lifted[i], pose.inlier[i] == 0, association, world_from_left);
  });
  std::vector<KeyPointMatch> matches;
  matches.reserve(pulls.size());
  for (const std::optional<KeyPointMatch>& pull : pulls)
    if (pull) matches.push_back(*pull);
  return matches;
}

}  // namespace softscope
