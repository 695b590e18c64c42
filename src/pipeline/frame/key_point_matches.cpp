#include "pipeline/frame/key_point_matches.h"

#include <algorithm>
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

/// In their order.
std::vector<KeyPointMatch> joined(const std::vector<std::vector<KeyPointMatch>>& parts) {
  std::size_t count = 0;
  for (const auto& part : parts) count += part.size();
  std::vector<KeyPointMatch> all;
  all.reserve(count);
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

std::vector<KeyPointMatch> keyPointMatches(const std::vector<LiftedMatch>& lifted,
                                           const RigidPose& pose,
                                           const AssociationOptions& association,
                                           const Eigen::Isometry3d& world_from_left) {
  if (!pose.found) return {};
  const int count = static_cast<int>(lifted.size());
  const int tasks = (count + kMatchesPerTask - 1) / kMatchesPerTask;
  std::vector<std::vector<KeyPointMatch>> parts(static_cast<std::size_t>(tasks));
  parallelRanges(tasks, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      parts[k].reserve(kMatchesPerTask);
      for (int i = k * kMatchesPerTask; i < std::min(count, (k + 1) * kMatchesPerTask); ++i)
        if (const auto pull =
                keyPointMatch(lifted[i], pose.inlier[i] == 0, association, world_from_left))
          parts[k].push_back(*pull);
    }
  });
  return joined(parts);
}

}  // namespace softscope
