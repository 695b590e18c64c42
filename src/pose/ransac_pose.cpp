#include "pose/ransac_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/error.h"
#include "pose/pose_settings.h"

namespace softscope {
namespace {

void requireOneEach(const PointPairs& pairs) {
  const std::size_t count = pairs.sources_mm.size();
  if (pairs.targets_mm.size() == count && (pairs.weights.empty() || pairs.weights.size() == count))
    return;
  throw Error("point pairs: " + std::to_string(count) + " sources, " +
              std::to_string(pairs.targets_mm.size()) + " targets and " +
              std::to_string(pairs.weights.size()) + " weights; one of each a pair is expected");
}

std::vector<int> usablePairs(const PointPairs& pairs) {
  std::vector<int> usable;
  for (std::size_t i = 0; i < pairs.sources_mm.size(); ++i)
    if (pairs.sources_mm[i].allFinite() && pairs.targets_mm[i].allFinite() && pairs.weight(i) > 0 &&
        std::isfinite(pairs.weight(i)))
      usable.push_back(static_cast<int>(i));
  return usable;
}

float squaredDistance(const PointPairs& pairs, int i, const Eigen::Isometry3f& motion) {
  const std::size_t k = static_cast<std::size_t>(i);
  return (motion * pairs.sources_mm[k] - pairs.targets_mm[k]).squaredNorm();
}

/// Sum of truncated squared distances; stops once it exceeds `best`.
double truncatedScore(const PointPairs& pairs, const std::vector<int>& usable,
                      const Eigen::Isometry3f& motion, float limit, double best) {
  double score = 0;
  for (std::size_t i = 0; i < usable.size() && score < best; ++i)
    score += std::min(squaredDistance(pairs, usable[i], motion), limit);
  return score;
}

std::vector<int> inliersOf(const PointPairs& pairs, const std::vector<int>& usable,
                           const Eigen::Isometry3d& motion, float limit) {
  const Eigen::Isometry3f motion_f = motion.cast<float>();
  std::vector<int> inliers;
  for (const int i : usable)
    if (squaredDistance(pairs, i, motion_f) <= limit) inliers.push_back(i);
  return inliers;
}

/// Three different pairs. mt19937 gives the same numbers
/// on all platforms, the standard distributions do not.
std::vector<int> drawThree(const std::vector<int>& usable, std::mt19937* random) {
  std::vector<int> drawn;
  while (drawn.size() < 3) {
    const std::uint64_t product = std::uint64_t{(*random)()} * usable.size();
    const int i = usable[static_cast<std::size_t>(product >> 32)];
    if (std::find(drawn.begin(), drawn.end(), i) == drawn.end()) drawn.push_back(i);
  }
  return drawn;
}

/// Whether the triangle keeps its shape to within the threshold and is not degenerate.
bool plausible(const PointPairs& pairs, const std::vector<int>& drawn, double threshold_mm) {
  const auto source = [&](int k) { return pairs.sources_mm[static_cast<std::size_t>(drawn[k])]; };
  const auto target = [&](int k) { return pairs.targets_mm[static_cast<std::size_t>(drawn[k])]; };
  for (int k = 0; k < 3; ++k) {
    const double change =
        (source(k) - source((k + 1) % 3)).norm() - (target(k) - target((k + 1) % 3)).norm();
    if (std::abs(change) > 2 * threshold_mm) return false;
  }
  const Eigen::Vector3f a = source(1) - source(0), b = source(2) - source(0);
  const float longest = std::max({a.norm(), b.norm(), (a - b).norm()});
  return a.cross(b).norm() > 0.05f * longest * longest && longest > threshold_mm;
}

/// Trials after which an all-inlier sample was drawn with the required confidence.
int trialsNeeded(double inlier_share, const RansacOptions& options) {
  const double all_good = std::pow(inlier_share, 3);
  if (all_good >= 1) return 1;
  if (all_good <= 0) return options.kMaxTrials;
  const double needed = std::log(1 - options.kConfidence) / std::log1p(-all_good);
  return static_cast<int>(std::min<double>(std::ceil(needed), options.kMaxTrials));
}

Eigen::Isometry3d bestOfTrials(const PointPairs& pairs, const std::vector<int>& usable,
                               const RansacOptions& options, int* trials) {
  const float limit = static_cast<float>(options.threshold_mm * options.threshold_mm);
  std::mt19937 random(options.seed);
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  // The identity is tried first: free, and right for many frames.
  double best_score = truncatedScore(pairs, usable, best.cast<float>(), limit,
                                     std::numeric_limits<double>::infinity());
  int needed = options.kMaxTrials;
  for (*trials = 0; *trials < needed; ++*trials) {
    const std::vector<int> drawn = drawThree(usable, &random);
    if (!plausible(pairs, drawn, options.threshold_mm)) continue;
    const Eigen::Isometry3d motion = fitPairs(pairs, drawn).target_from_source;
    const double score = truncatedScore(pairs, usable, motion.cast<float>(), limit, best_score);
    if (score >= best_score) continue;
    best = motion;
    best_score = score;
    const double share = static_cast<double>(inliersOf(pairs, usable, motion, limit).size()) /
                         static_cast<double>(usable.size());
    needed = trialsNeeded(share, options);
  }
  return best;
}

std::string tooFew(std::size_t found, const char* what, int needed) {
  return std::to_string(found) + " " + what + ", but " + std::to_string(needed) + " are needed";
}

void keepPose(const PointPairs& pairs, const std::vector<int>& inliers,
              const Eigen::Isometry3d& motion, RigidPose* pose) {
  pose->found = true;
  pose->target_from_source = motion;
  pose->inliers = static_cast<int>(inliers.size());
  double sum = 0;
  for (const int i : inliers) {
    pose->inlier[static_cast<std::size_t>(i)] = 1;
    sum += squaredDistance(pairs, i, motion.cast<float>());
  }
  pose->rms_mm = std::sqrt(sum / static_cast<double>(inliers.size()));
}

}  // namespace

void RansacOptions::validate() const { requireAllowed(*this); }

RigidPose estimateRigidPose(const PointPairs& pairs, const RansacOptions& options) {
  options.validate();
  requireOneEach(pairs);
  RigidPose pose;
  pose.inlier.assign(pairs.sources_mm.size(), 0);
  const std::vector<int> usable = usablePairs(pairs);
  pose.usable = static_cast<int>(usable.size());
  if (pose.usable < options.kMinInliers) {
    pose.failure = tooFew(usable.size(), "usable pairs", options.kMinInliers);
    return pose;
  }
  const float limit = static_cast<float>(options.threshold_mm * options.threshold_mm);
  const int needed =
      std::max(options.kMinInliers, static_cast<int>(std::ceil(options.kMinShare * pose.usable)));
  Eigen::Isometry3d motion = bestOfTrials(pairs, usable, options, &pose.trials);
  std::vector<int> inliers = inliersOf(pairs, usable, motion, limit);
  for (int k = 0; k < options.kRefits; ++k) {
    if (static_cast<int>(inliers.size()) < needed) {
      pose.failure = tooFew(inliers.size(), "inliers", needed);
      return pose;
    }
    const PairFit fit = fitPairs(pairs, inliers);
    if (!(fit.spread_mm >= options.kMinSpreadMm)) {
      pose.failure = "the inliers lie on a line, which leaves the rotation about it open";
      return pose;
    }
    motion = fit.target_from_source;
    inliers = inliersOf(pairs, usable, motion, limit);
  }
  if (static_cast<int>(inliers.size()) < needed)
    pose.failure = tooFew(inliers.size(), "inliers", needed);
  else
    keepPose(pairs, inliers, motion, &pose);
  return pose;
}

}  // namespace softscope
