// eval/motion/trajectory_errors.cpp: pose differences after alignment.
#include "eval/motion/trajectory_errors.h"

#include <cmath>
#include <string>

#include "core/error.h"
#include "eval/alignment/rigid_alignment.h"

namespace softscope {
namespace {

using Poses = std::vector<Eigen::Isometry3d>;

void check(const Poses& truth, const Poses& estimate) {
  if (truth.size() != estimate.size() || truth.empty())
    throw InputError("a trajectory of " + std::to_string(estimate.size()) +
                     " poses can't be compared with " + std::to_string(truth.size()) +
                     " true ones; give one true pose per pose, and at least one");
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (!truth[i].matrix().allFinite() || !estimate[i].matrix().allFinite())
      throw InputError("pose " + std::to_string(i) +
                       " of a trajectory is not finite; leave such poses out");
}

void add(const Eigen::Isometry3d& difference, PoseErrors& errors) {
  const Eigen::Quaterniond turn(difference.linear());
  errors.each_mm.push_back(difference.translation().norm());
  errors.each_deg.push_back(2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 180 / M_PI);
}

void summarise(PoseErrors& errors) {
  errors.translation_mm = statistics(errors.each_mm);
  errors.rotation_deg = statistics(errors.each_deg);
}

/// Of truth and `truth_from_estimate` * estimate.
PoseErrors poseErrors(const Poses& truth, const Poses& estimate,
                      const Eigen::Isometry3d& truth_from_estimate) {
  PoseErrors errors;
  for (std::size_t i = 0; i < truth.size(); ++i)
    add(truth[i].inverse() * (truth_from_estimate * estimate[i]), errors);
  summarise(errors);
  return errors;
}

PoseErrors stepErrors(const Poses& truth, const Poses& estimate, const std::vector<int>& moments) {
  PoseErrors errors;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    if (!moments.empty() && moments[i] != moments[i - 1] + 1) {
      errors.each_mm.push_back(Statistics::kNone);
      errors.each_deg.push_back(Statistics::kNone);
      continue;
    }
    const Eigen::Isometry3d true_step = truth[i - 1].inverse() * truth[i];
    add(true_step.inverse() * (estimate[i - 1].inverse() * estimate[i]), errors);
  }
  summarise(errors);
  return errors;
}

RigidFit fitPositions(const Poses& truth, const Poses& estimate) {
  std::vector<Eigen::Vector3d> source_mm, target_mm;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    source_mm.push_back(estimate[i].translation());
    target_mm.push_back(truth[i].translation());
  }
  if (source_mm.size() >= 3) return fitRigid(source_mm, target_mm);
  RigidFit fit;  // one or two positions: translation of their mean
  fit.target_from_source.translation() =
      (target_mm.front() + target_mm.back() - source_mm.front() - source_mm.back()) / 2;
  return fit;
}

/// `estimate` with positions transformed into the true world, including scale.
Poses similar(const Poses& estimate, const SimilarityFit& fit) {
  Poses moved;
  for (Eigen::Isometry3d pose : estimate) {
    pose.translation() = fit.scale * (fit.rotation * pose.translation()) + fit.translation_mm;
    pose.linear() = fit.rotation * pose.linear();
    moved.push_back(pose);
  }
  return moved;
}

/// `truth` has three or more positions that are not collinear.
void addScaled(const Poses& truth, const Poses& estimate, const std::vector<int>& moments,
               TrajectoryErrors& errors) {
  std::vector<Eigen::Vector3d> source_mm, target_mm;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    source_mm.push_back(estimate[i].translation());
    target_mm.push_back(truth[i].translation());
  }
  const SimilarityFit fit = fitSimilarity(source_mm, target_mm);
  const Poses moved = similar(estimate, fit);
  errors.scale = fit.scale;
  errors.absolute_scaled = poseErrors(truth, moved, Eigen::Isometry3d::Identity());
  errors.relative_scaled = stepErrors(truth, moved, moments);
}

}  // namespace

TrajectoryErrors trajectoryErrors(const Poses& truth, const Poses& estimate,
                                  const std::vector<int>& moments) {
  check(truth, estimate);
  if (!moments.empty() && moments.size() != truth.size())
    throw InputError("a trajectory needs one moment per pose, or none");
  const RigidFit fit = fitPositions(truth, estimate);
  TrajectoryErrors errors;
  errors.unaligned = poseErrors(truth, estimate, Eigen::Isometry3d::Identity());
  errors.absolute = poseErrors(truth, estimate, fit.target_from_source);
  errors.relative = stepErrors(truth, estimate, moments);
  errors.truth_from_estimate = fit.target_from_source;
  errors.alignment_unique = fit.unique;
  if (!fit.unique) {
    errors.absolute.each_deg.assign(truth.size(), Statistics::kNone);
    summarise(errors.absolute);
  } else {
    addScaled(truth, estimate, moments, errors);
  }
  return errors;
}

}  // namespace softscope
