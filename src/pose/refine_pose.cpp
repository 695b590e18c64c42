#include "pose/refine_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "pose/pose_settings.h"

namespace softscope {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// A scope that moved has stopped once its position is this close to the last one, in standard
// errors.
constexpr double kRestSigmas = 3;

// Tissue has its reference shape while that explains this share of the matches.
constexpr double kRigidShare = 2.0 / 3;

constexpr double kSeenSigmas =
    6;  // of a shift that is seen in a single pair: two poses explain it to three

// Robust scale of a pair over the median residual. From frame to frame most of the tissue moves
// little, and what moves more is not of the scope. In a gap all of it has moved.
constexpr double kScaleOfMedian = 0.5, kScaleAfterGap = 1.5;

// Of the median residual after a motion of the scope, match
// errors included; deformed tissue leaves a larger share.
constexpr double kLeftShare = 1.0 / 3;

// Width and height that the regions divide at least, of those of the image: the errors of near
// pairs are correlated. With a half, an organ of a fifth of the image has no error and no motion.
constexpr double kLeastExtent = 0.4;

/// Upper quantile of the normal distribution (Abramowitz and Stegun 26.2.23, to 4.5e-4).
double normalQuantile(double probability) {
  const double t = std::sqrt(-2 * std::log(probability));
  return t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                 (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
}

/// Upper quantile of Student's t distribution (Abramowitz and Stegun 26.7.5).
double studentQuantile(double probability, double freedom) {
  const double z = normalQuantile(probability), sq = z * z;
  return z * (1 + (sq + 1) / (4 * freedom) + ((5 * sq + 16) * sq + 3) / (96 * freedom * freedom) +
              (((3 * sq + 19) * sq + 17) * sq - 15) / (384 * freedom * freedom * freedom));
}

/// Area of the regions: the extent of the pairs in the live image, if it is not too small.
Eigen::AlignedBox2d extentOf(const std::vector<PosePair>& pairs, const PinholeCamera& camera) {
  Eigen::AlignedBox2d extent;
  for (const PosePair& pair : pairs)
    if (pair.live_px.allFinite()) extent.extend(pair.live_px);
  if (extent.isEmpty()) return extent;
  const Eigen::Vector2d half =
      0.5 * kLeastExtent * Eigen::Vector2d(camera.width_px, camera.height_px);
  const Eigen::Vector2d middle = extent.center();
  return extent.extend(Eigen::AlignedBox2d(middle - half, middle + half));
}

constexpr int kFewestRegions = 8;  // with pairs; with fewer, motion and error are unknown

SeenPair seenPair(const PosePair& pair) {
  SeenPair seen{};
  for (int c = 0; c < 3; ++c) {
    seen.place_mm[static_cast<int>(PairPlace::kNow)][c] = pair.model_world_mm[c];
    seen.place_mm[static_cast<int>(PairPlace::kSince)][c] = pair.reference_world_mm[c];
  }
  seen.live_px[0] = pair.live_px.x();
  seen.live_px[1] = pair.live_px.y();
  seen.disparity_px = pair.disparity_px;
  seen.across = 1 / std::hypot(RefinePoseOptions::kNoisePx, pair.sigma_px);
  seen.along = 1 / std::hypot(RefinePoseOptions::kDisparityNoisePx, pair.sigma_disparity_px);
  return seen;
}

int usedOf(const std::array<int, kRegions>& counts) {
  return kRegions - static_cast<int>(std::count(counts.begin(), counts.end(), 0));
}

/// Student's test of a mean gain above 0; the regions are the samples.
bool isGain(const std::array<double, kRegions>& gains, const std::array<int, kRegions>& counts,
            double significance) {
  const int regions = usedOf(counts);
  if (regions < kFewestRegions) return false;
  const int count = std::accumulate(counts.begin(), counts.end(), 0);
  const double mean = std::accumulate(gains.begin(), gains.end(), 0.0) / count;
  double spread = 0;
  for (std::size_t k = 0; k < gains.size(); ++k) spread += std::pow(gains[k] - mean * counts[k], 2);
  const double error = std::sqrt(spread * regions / (regions - 1.0)) / count;
  return mean > studentQuantile(significance, regions - 1.0) * error;
}

/// Whether the scope moved since the last frame: most of the pairs distinguish both poses, the new
/// one leaves a small part of the residuals, and is significantly better: docs/energy.md (29).
bool differs(const PoseFindings& found, double significance) {
  return found.shift > kSeenSigmas && found.length < kLeftShare * found.old_length &&
         isGain(found.gains, found.counts, significance);
}

/// Of the best pose as a twist in the left camera frame: jackknife over regions, (31).
Matrix6d covarianceOf(const PoseFindings& found) {
  const int regions = usedOf(found.score_counts);
  if (regions < kFewestRegions) return Matrix6d::Constant(PoseFindings::kNan);
  Matrix6d normal = Matrix6d::Zero(), spread = Matrix6d::Zero();
  for (const Matrix6d& part : found.normals) normal += part;
  for (std::size_t r = 0; r < found.normals.size(); ++r) {
    const Vector6d change = (normal - found.normals[r]).ldlt().solve(found.scores[r]);
    spread += change * change.transpose();
  }
  return spread * (regions - 1.0) / regions;
}

/// 1 where the reference shape explains all matches, 0 from kRigidShare on: what deforming tissue
/// tells of a scope at rest must not begin at once.
double rigidity(double share_since) {
  return std::max(0.0, (share_since - kRigidShare) / (1 - kRigidShare));
}

/// The pose at that share of the way.
Eigen::Isometry3d towards(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                          double share) {
  if (share == 0) return from;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = from.translation() + share * (to.translation() - from.translation());
  pose.linear() = Eigen::Quaterniond(from.linear())
                      .slerp(share, Eigen::Quaterniond(to.linear()))
                      .toRotationMatrix();
  return pose;
}

}  // namespace

void RefinePoseOptions::validate() const { requireAllowed(*this); }

PoseQuestion poseQuestion(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                          const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                          const Eigen::Isometry3d& reference, ScopeBefore before,
                          const RefinePoseOptions& options) {
  PoseQuestion question;
  question.pairs.reserve(pairs.size());
  for (const PosePair& pair : pairs) question.pairs.push_back(seenPair(pair));
  question.rig = rig;
  const Eigen::AlignedBox2d extent = extentOf(pairs, rig.left);
  for (int c = 0; c < 2; ++c) {
    question.regions.first_px[c] = extent.min()[c];
    question.regions.size_px[c] = extent.sizes()[c];
  }
  question.fitted = fitted.inverse();
  question.old = last.inverse();
  question.before = reference.inverse();
  question.scale_of_median = before == ScopeBefore::kUnclear ? kScaleAfterGap : kScaleOfMedian;
  question.iterations = options.iterations;
  return question;
}

RefinedPose refinePose(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                       const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                       const Eigen::Isometry3d& reference, ScopeBefore before,
                       const RefinePoseOptions& options, PoseSearch* search) {
  options.validate();
  CpuPoseSearch on_cpu;
  const PoseAnswer answer =
      (search != nullptr ? *search : on_cpu)
          .answer(poseQuestion(pairs, rig, fitted, last, reference, before, options));
  const PoseFindings &now = answer.now, &since = answer.since;
  const double share_since =
      pairs.empty() ? 0 : static_cast<double>(since.explained) / static_cast<double>(pairs.size());
  const bool rigid = share_since >= kRigidShare;
  const PoseFindings& found = rigid ? since : now;
  const Eigen::Isometry3d& measured = found.best;
  const Matrix6d covariance = covarianceOf(found);
  RefinedPose refined;
  refined.moved_mm = (measured.inverse().translation() - reference.translation()).norm();
  refined.sigma_mm = std::sqrt(covariance.diagonal().tail<3>().sum());
  refined.sigma_deg = 180 / M_PI * std::sqrt(covariance.diagonal().head<3>().sum());
  const double moved_sigmas = refined.moved_mm / refined.sigma_mm;
  const bool is_far =
      before == ScopeBefore::kMoving
          ? moved_sigmas > kRestSigmas
          : rigid && moved_sigmas >
                         studentQuantile(options.significance, usedOf(found.score_counts) - 1.0);
  const bool moves = options.scope == "moving" || before == ScopeBefore::kUnclear ||
                     differs(now, options.significance) || is_far;
  refined.scope_static = options.scope == "static" || !moves;
  refined.keeps_shape = refined.scope_static || rigid;
  if (options.scope == "static")
    refined.world_from_left = reference;
  else if (moves)
    refined.world_from_left = measured.inverse();
  else
    refined.world_from_left = towards(last, measured.inverse(), rigidity(share_since));
  return refined;
}

}  // namespace softscope
