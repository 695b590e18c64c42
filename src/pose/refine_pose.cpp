#include "pose/refine_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/median.h"
#include "core/parallel.h"
#include "pose/pose_settings.h"

namespace softscope {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kPairsATask = 256;
constexpr double kConvergedMm = 1e-4;
constexpr double kTypicalDepthMm = 50;  // turns a rotation into a shift, to judge convergence
constexpr double kCostScaleSq = 9;      // three standard errors

// Tissue has its reference shape as long as that explains this share of the matches.
constexpr double kRigidShare = 2.0 / 3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr double kSeenSigmas =
    6;  // of a shift that is seen in a single pair: two poses explain it to three

// Of the median residual that a motion of the scope leaves, match errors included; tissue that
// bends leaves more of it.
constexpr double kLeftShare = 1.0 / 3;

// Parts of the pairs' extent in the image, whose errors are independent.
constexpr int kRegionColumns = 6, kRegionRows = 4, kRegions = kRegionColumns * kRegionRows;
constexpr int kFewestRegions = 8;  // with pairs; below, neither motion nor error is known

/// Which place of a pair the model has.
using Place = Eigen::Vector3d PosePair::*;

/// Whitened residuals of one pair (u, v, disparity) and their slopes by a twist of the pose.
struct Residual {
  Eigen::Vector3d value;
  Eigen::Matrix<double, 3, 6> slope;
  bool usable = false;
};

/// docs/energy.md (26).
Residual residualOf(const PosePair& pair, Place place, const RectifiedRig& rig,
                    const Eigen::Isometry3d& left_from_world) {
  Residual out;
  const Eigen::Vector3d p = left_from_world * pair.*place;
  const double across = 1 / std::hypot(RefinePoseOptions::kNoisePx, pair.sigma_px);
  const double along =
      1 / std::hypot(RefinePoseOptions::kDisparityNoisePx, pair.sigma_disparity_px);
  if (!(p.z() > 1e-3) || !std::isfinite(across) || !std::isfinite(along)) return out;
  const double fx = rig.left.fx_px, fy = rig.left.fy_px, z = p.z();
  Eigen::Matrix3d by_point;
  by_point << fx / z, 0, -fx * p.x() / (z * z), 0, fy / z, -fy * p.y() / (z * z), 0, 0,
      -fx * rig.baseline_mm / (z * z);
  Eigen::Matrix<double, 3, 6> by_twist;  // rotation, then translation: p' = p + w x p + t
  by_twist << 0, z, -p.y(), 1, 0, 0, -z, 0, p.x(), 0, 1, 0, p.y(), -p.x(), 0, 0, 0, 1;
  const Eigen::Vector3d weights(across, across, along);
  out.value << projectPoint(rig.left, p) - pair.live_px, rig.disparityPx(z) - pair.disparity_px;
  out.value = weights.cwiseProduct(out.value);
  out.slope = weights.asDiagonal() * (by_point * by_twist);
  out.usable = out.value.allFinite();
  return out;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Vector6d& twist) {
  const Eigen::Vector3d turn = twist.head<3>();
  Eigen::Isometry3d by = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0) by.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
  by.translation() = twist.tail<3>();
  return by * pose;
}

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

/// What the regions divide: the pairs' extent in the live image, but half of the image at least,
/// because the errors of near pairs are alike.
Eigen::AlignedBox2d extentOf(const std::vector<PosePair>& pairs, const PinholeCamera& camera) {
  Eigen::AlignedBox2d extent;
  for (const PosePair& pair : pairs)
    if (pair.live_px.allFinite()) extent.extend(pair.live_px);
  if (extent.isEmpty()) return extent;
  const Eigen::Vector2d half(0.25 * camera.width_px, 0.25 * camera.height_px);
  const Eigen::Vector2d middle = extent.center();
  return extent.extend(Eigen::AlignedBox2d(middle - half, middle + half));
}

/// The pairs, seen from any pose.
class Pairs {
 public:
  Pairs(const std::vector<PosePair>& pairs, Place place, const RectifiedRig& rig,
        const RefinePoseOptions& options)
      : pairs_(pairs),
        place_(place),
        rig_(rig),
        options_(options),
        extent_px_(extentOf(pairs, rig.left)) {}

  /// The best end of the searches that begin at both poses.
  Eigen::Isometry3d search(const Eigen::Isometry3d& left_from_world,
                           const Eigen::Isometry3d& other_left_from_world) const {
    Eigen::Isometry3d one, other;
    parallelInvoke([&] { one = searchFrom(left_from_world); },
                   [&] { other = searchFrom(other_left_from_world); });
    return costAt(other) < costAt(one) ? other : one;
  }

  /// Whether `best` is another pose than `old`: most of the pairs see the difference, `best` leaves
  /// little of their residuals, and explains them significantly better: docs/energy.md (29).
  bool differs(const Eigen::Isometry3d& best, const Eigen::Isometry3d& old) const {
    std::vector<double> shifts, lengths, old_lengths;
    std::array<double, kRegions> gains{};
    std::array<int, kRegions> counts{};
    for (const PosePair& pair : pairs_) {
      const Residual here = residualAt(pair, best), there = residualAt(pair, old);
      if (!here.usable || !there.usable) continue;
      shifts.push_back((here.value - there.value).norm());
      lengths.push_back(here.value.norm());
      old_lengths.push_back(there.value.norm());
      const std::size_t region = regionOf(pair.live_px);
      gains[region] += costOf(there) - costOf(here);
      ++counts[region];
    }
    return medianOf(std::move(shifts)) > kSeenSigmas &&
           medianOf(std::move(lengths)) < kLeftShare * medianOf(std::move(old_lengths)) &&
           isGain(gains, counts);
  }

  /// Covariance of the pose as a twist in the left camera's frame, clustered by regions: (31).
  Matrix6d covarianceAt(const Eigen::Isometry3d& left_from_world) const {
    std::vector<Vector6d> scores(kRegions, Vector6d::Zero());
    std::array<int, kRegions> counts{};
    Matrix6d normal = Matrix6d::Zero();
    for (const PosePair& pair : pairs_) {
      const Residual residual = residualAt(pair, left_from_world);
      if (!residual.usable) continue;
      const double weight = weightOf(residual, kCostScaleSq);
      normal += weight * residual.slope.transpose() * residual.slope;
      const std::size_t region = regionOf(pair.live_px);
      scores[region] += weight * residual.slope.transpose() * residual.value;
      ++counts[region];
    }
    const int regions = usedOf(counts);
    if (regions < kFewestRegions) return Matrix6d::Constant(kNan);
    Matrix6d spread = Matrix6d::Zero();
    for (const Vector6d& score : scores) spread += score * score.transpose();
    const Matrix6d inverse = normal.ldlt().solve(Matrix6d::Identity());
    return inverse * spread * inverse * regions / (regions - 1.0);
  }

  /// Share of the pairs that a pose puts where they were found, to three standard errors.
  double explainedBy(const Eigen::Isometry3d& left_from_world) const {
    int explained = 0;
    for (const PosePair& pair : pairs_) {
      const Residual residual = residualAt(pair, left_from_world);
      explained += residual.usable && residual.value.squaredNorm() < kCostScaleSq;
    }
    return pairs_.empty() ? 0 : static_cast<double>(explained) / static_cast<double>(pairs_.size());
  }

 private:
  /// Student's test that the mean gain is above 0; regions are the samples.
  bool isGain(const std::array<double, kRegions>& gains,
              const std::array<int, kRegions>& counts) const {
    const int regions = usedOf(counts);
    if (regions < kFewestRegions) return false;
    const int count = std::accumulate(counts.begin(), counts.end(), 0);
    const double mean = std::accumulate(gains.begin(), gains.end(), 0.0) / count;
    double spread = 0;
    for (std::size_t k = 0; k < gains.size(); ++k)
      spread += std::pow(gains[k] - mean * counts[k], 2);
    const double error = std::sqrt(spread * regions / (regions - 1.0)) / count;
    return mean > studentQuantile(options_.significance, regions - 1.0) * error;
  }

  static double costOf(const Residual& residual) {
    const double squared = residual.value.squaredNorm();
    return squared / (squared + kCostScaleSq);
  }

  static double weightOf(const Residual& residual, double scale_sq) {
    const double share = scale_sq / (scale_sq + residual.value.squaredNorm());
    return share * share;
  }

  static int usedOf(const std::array<int, kRegions>& counts) {
    return kRegions - static_cast<int>(std::count(counts.begin(), counts.end(), 0));
  }

  std::size_t regionOf(const Eigen::Vector2d& live_px) const {
    const Eigen::Array2d share = (live_px - extent_px_.min()).array() / extent_px_.sizes().array();
    const auto region = [](double part, int count) {
      return std::clamp(static_cast<int>(part * count), 0, count - 1);
    };
    return static_cast<std::size_t>(region(share.y(), kRegionRows) * kRegionColumns +
                                    region(share.x(), kRegionColumns));
  }

  Residual residualAt(const PosePair& pair, const Eigen::Isometry3d& left_from_world) const {
    return residualOf(pair, place_, rig_, left_from_world);
  }

  std::vector<Residual> residualsAt(const Eigen::Isometry3d& left_from_world) const {
    std::vector<Residual> residuals(pairs_.size());
    parallelRanges(static_cast<int>(pairs_.size()), kPairsATask, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        residuals[i] = residualAt(pairs_[i], left_from_world);
      }
    });
    const auto unusable = [](const Residual& residual) { return !residual.usable; };
    residuals.erase(std::remove_if(residuals.begin(), residuals.end(), unusable), residuals.end());
    return residuals;
  }

  /// Mean robust cost of a pair, 0 to 1: docs/energy.md (28).
  double costAt(const Eigen::Isometry3d& left_from_world) const {
    const std::vector<Residual> residuals = residualsAt(left_from_world);
    double sum = 0;
    for (const Residual& residual : residuals) sum += costOf(residual);
    return residuals.empty() ? 1 : sum / static_cast<double>(residuals.size());
  }

  Eigen::Isometry3d searchFrom(Eigen::Isometry3d left_from_world) const {
    for (int i = 0; i < options_.iterations; ++i) {
      const Vector6d twist = stepFrom(left_from_world);
      left_from_world = moved(left_from_world, twist);
      if (twist.tail<3>().norm() + kTypicalDepthMm * twist.head<3>().norm() < kConvergedMm) break;
    }
    return left_from_world;
  }

  /// docs/energy.md (27): the scale follows the median, so that half of the pairs always count.
  Vector6d stepFrom(const Eigen::Isometry3d& left_from_world) const {
    const std::vector<Residual> residuals = residualsAt(left_from_world);
    if (residuals.size() < 3) return Vector6d::Zero();
    std::vector<double> squares;
    for (const Residual& residual : residuals) squares.push_back(residual.value.squaredNorm());
    const double scale_sq =
        std::max(1.0, std::pow(RefinePoseOptions::kRobustScale, 2) * medianOf(squares));
    Matrix6d normal = Matrix6d::Zero();
    Vector6d right = Vector6d::Zero();
    for (const Residual& residual : residuals) {
      const double weight = weightOf(residual, scale_sq);
      normal += weight * residual.slope.transpose() * residual.slope;
      right -= weight * residual.slope.transpose() * residual.value;
    }
    const Vector6d twist = normal.ldlt().solve(right);
    return twist.allFinite() ? twist : Vector6d(Vector6d::Zero());
  }

  const std::vector<PosePair>& pairs_;
  const Place place_;
  const RectifiedRig& rig_;
  const RefinePoseOptions& options_;
  const Eigen::AlignedBox2d extent_px_;
};

}  // namespace

void RefinePoseOptions::validate() const { requireAllowed(*this); }

RefinedPose refinePose(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                       const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                       const Eigen::Isometry3d& reference, const RefinePoseOptions& options) {
  options.validate();
  const Pairs now(pairs, &PosePair::model_world_mm, rig, options),
      since(pairs, &PosePair::reference_world_mm, rig, options);
  const Eigen::Isometry3d old = last.inverse(), before = reference.inverse();
  const Eigen::Isometry3d best = now.search(fitted.inverse(), old);
  const Eigen::Isometry3d best_since = since.search(best, before);
  const bool moved_now = now.differs(best, old), moved_since = since.differs(best_since, before);
  const bool rigid = since.explainedBy(best_since) >= kRigidShare;
  const bool moves = options.scope == "moving" || moved_now || (rigid && moved_since);
  const Eigen::Isometry3d& measured = rigid ? best_since : best;
  const Matrix6d covariance = (rigid ? since : now).covarianceAt(measured);
  RefinedPose refined;
  refined.moved_mm = (measured.inverse().translation() - reference.translation()).norm();
  refined.sigma_mm = std::sqrt(covariance.diagonal().tail<3>().sum());
  refined.sigma_deg = 180 / M_PI * std::sqrt(covariance.diagonal().head<3>().sum());
  refined.scope_static = options.scope == "static" || !moves;
  refined.keeps_shape = refined.scope_static || rigid;
  if (options.scope == "static")
    refined.world_from_left = reference;
  else
    refined.world_from_left = rigid || moves ? measured.inverse() : last;
  return refined;
}

}  // namespace softscope
