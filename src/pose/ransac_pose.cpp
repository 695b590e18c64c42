#include "pose/ransac_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/error.h"
#include "pose/pair_columns.h"
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

float limitOf(const RansacOptions& options) {
  return static_cast<float>(options.threshold_mm * options.threshold_mm);
}

struct Inliers {
  Inliers(const PairColumns& pairs, const Eigen::Isometry3d& motion, float limit)
      : squares(pairs.squaredDistances(motion.cast<float>())),
        count(static_cast<int>((squares <= limit).count())) {}

  Eigen::ArrayXf squares;  // of the distance of each pair
  int count;               // of those up to the limit
};

/// Three different pairs. mt19937 gives the same numbers
/// on all platforms, the standard distributions do not.
std::vector<int> drawThree(int usable, std::mt19937* random) {
  std::vector<int> drawn;
  while (drawn.size() < 3) {
    const std::uint64_t product = std::uint64_t{(*random)()} * static_cast<std::uint64_t>(usable);
    const int i = static_cast<int>(product >> 32);
    if (std::find(drawn.begin(), drawn.end(), i) == drawn.end()) drawn.push_back(i);
  }
  return drawn;
}

/// Whether the triangle keeps its shape to within the threshold and is not degenerate.
bool plausible(const PairColumns& pairs, const std::vector<int>& drawn, double threshold_mm) {
  const auto source = [&](int k) { return pairs.source(drawn[k]); };
  const auto target = [&](int k) { return pairs.target(drawn[k]); };
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

Eigen::Isometry3d fitTo(const PairColumns& pairs, const std::vector<int>& drawn) {
  PairSums sums;
  for (const int i : drawn)
    sums.add(pairs.source(i).cast<double>(), pairs.target(i).cast<double>(), pairs.weight(i));
  return fitPairs(sums).target_from_source;
}

Eigen::Isometry3d bestOfTrials(const PairColumns& pairs, const RansacOptions& options,
                               int* trials) {
  const float limit = limitOf(options);
  std::mt19937 random(options.seed);
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  // The identity is tried first: free, and right for many frames.
  double best_score =
      pairs.truncatedScore(best.cast<float>(), limit, std::numeric_limits<double>::infinity());
  int needed = options.kMaxTrials;
  for (*trials = 0; *trials < needed; ++*trials) {
    const std::vector<int> drawn = drawThree(pairs.size(), &random);
    if (!plausible(pairs, drawn, options.threshold_mm)) continue;
    const Eigen::Isometry3d motion = fitTo(pairs, drawn);
    const double score = pairs.truncatedScore(motion.cast<float>(), limit, best_score);
    if (score >= best_score) continue;
    best = motion;
    best_score = score;
    const Inliers inliers(pairs, motion, limit);
    needed = trialsNeeded(inliers.count / static_cast<double>(pairs.size()), options);
  }
  return best;
}

std::string tooFew(int found, const char* what, int needed) {
  return std::to_string(found) + " " + what + ", but " + std::to_string(needed) + " are needed";
}

void keepPose(const PairColumns& pairs, const Inliers& inliers, float limit,
              const Eigen::Isometry3d& motion, RigidPose* pose) {
  pose->found = true;
  pose->target_from_source = motion;
  pose->inliers = inliers.count;
  double sum = 0;
  for (int i = 0; i < pairs.size(); ++i) {
    if (!(inliers.squares[i] <= limit)) continue;
    pose->inlier[pairs.pair(i)] = 1;
    sum += inliers.squares[i];
  }
  pose->rms_mm = std::sqrt(sum / inliers.count);
}

}  // namespace

void RansacOptions::validate() const { requireAllowed(*this); }

RigidPose estimateRigidPose(const PointPairs& given, const RansacOptions& options) {
  options.validate();
  requireOneEach(given);
  RigidPose pose;
  pose.inlier.assign(given.sources_mm.size(), 0);
  const PairColumns pairs(given);
  pose.usable = pairs.size();
  if (pose.usable < options.kMinInliers) {
    pose.failure = tooFew(pose.usable, "usable pairs", options.kMinInliers);
    return pose;
  }
  const float limit = limitOf(options);
  const int needed =
      std::max(options.kMinInliers, static_cast<int>(std::ceil(options.kMinShare * pose.usable)));
  Eigen::Isometry3d motion = bestOfTrials(pairs, options, &pose.trials);
  Inliers inliers(pairs, motion, limit);
  for (int k = 0; k < options.kRefits; ++k) {
    if (inliers.count < needed) {
      pose.failure = tooFew(inliers.count, "inliers", needed);
      return pose;
    }
    const PairFit fit = fitPairs(pairs.sumsWithin(inliers.squares, limit));
    if (!(fit.spread_mm >= options.kMinSpreadMm)) {
      pose.failure = "the inliers lie on a line, which leaves the rotation about it open";
      return pose;
    }
    motion = fit.target_from_source;
    inliers = Inliers(pairs, motion, limit);
  }
  if (inliers.count < needed)
    pose.failure = tooFew(inliers.count, "inliers", needed);
  else
    keepPose(pairs, inliers, limit, motion, &pose);
  return pose;
}

}  // namespace softscope
