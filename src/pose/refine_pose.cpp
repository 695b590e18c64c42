#include "pose/refine_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace softscope {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kConvergedMm = 1e-4;
constexpr double kTypicalDepthMm = 50;  // turns a rotation into a shift, to judge convergence
constexpr double kCostScaleSq = 9;      // three standard errors
constexpr double kExplainedSigmas = 3;  // of a pair that a pose explains
constexpr double kTellingShare = 0.5;   // where no motion explains half as many, there was one

/// Whitened residuals of one pair (u, v, disparity) and their slopes by a twist of the pose.
struct Residual {
  Eigen::Vector3d value;
  Eigen::Matrix<double, 3, 6> slope;
  bool usable = false;
};

/// docs/energy.md (26).
Residual residualOf(const PosePair& pair, const RectifiedRig& rig,
                    const Eigen::Isometry3d& left_from_world, const RefinePoseOptions& options) {
  Residual out;
  const Eigen::Vector3d p = left_from_world * pair.model_world_mm;
  const double across = 1 / std::hypot(options.noise_px, pair.sigma_px);
  const double along = 1 / std::hypot(options.disparity_noise_px, pair.sigma_disparity_px);
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

double medianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Vector6d& twist) {
  const Eigen::Vector3d turn = twist.head<3>();
  Eigen::Isometry3d by = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0) by.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
  by.translation() = twist.tail<3>();
  return by * pose;
}

/// The pairs, seen from any pose.
class Pairs {
 public:
  Pairs(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
        const RefinePoseOptions& options)
      : pairs_(pairs), rig_(rig), options_(options) {}

  Eigen::Isometry3d search(Eigen::Isometry3d left_from_world) const {
    for (int i = 0; i < options_.iterations; ++i) {
      const Vector6d twist = stepFrom(left_from_world);
      left_from_world = moved(left_from_world, twist);
      if (twist.tail<3>().norm() + kTypicalDepthMm * twist.head<3>().norm() < kConvergedMm) break;
    }
    return left_from_world;
  }

  /// Mean robust cost of a pair, 0 to 1: docs/energy.md (28).
  double costAt(const Eigen::Isometry3d& left_from_world) const {
    double sum = 0;
    int count = 0;
    for (const Residual& residual : residualsAt(left_from_world)) {
      const double squared = residual.value.squaredNorm();
      sum += squared / (squared + kCostScaleSq);
      ++count;
    }
    return count > 0 ? sum / count : 1;
  }

  /// Median distance across the ray between where pairs are and where the pose has them.
  double shiftMm(const Eigen::Isometry3d& left_from_world) const {
    std::vector<double> shifts;
    for (const PosePair& pair : pairs_) {
      const Eigen::Vector3d p = left_from_world * pair.model_world_mm;
      if (p.z() > 0)
        shifts.push_back((projectPoint(rig_.left, p) - pair.live_px).norm() * p.z() /
                         rig_.left.fx_px);
    }
    return medianOf(std::move(shifts));
  }

  /// Share of the pairs that a pose puts where they were found, to three standard errors.
  double explainedBy(const Eigen::Isometry3d& left_from_world) const {
    int pairs = 0, explained = 0;
    for (const PosePair& pair : pairs_) {
      const Eigen::Vector3d p = left_from_world * pair.model_world_mm;
      if (!(p.z() > 0)) continue;
      ++pairs;
      explained += (projectPoint(rig_.left, p) - pair.live_px).norm() <
                   kExplainedSigmas * std::hypot(options_.noise_px, pair.sigma_px);
    }
    return pairs > 0 ? static_cast<double>(explained) / pairs : 0;
  }

  double disparityOffsetPx(const Eigen::Isometry3d& left_from_world) const {
    std::vector<double> offsets;
    for (const PosePair& pair : pairs_) {
      const double z = (left_from_world * pair.model_world_mm).z();
      if (z > 0) offsets.push_back(pair.disparity_px - rig_.disparityPx(z));
    }
    return offsets.empty() ? 0 : medianOf(std::move(offsets));
  }

 private:
  std::vector<Residual> residualsAt(const Eigen::Isometry3d& left_from_world) const {
    std::vector<Residual> residuals;
    residuals.reserve(pairs_.size());
    for (const PosePair& pair : pairs_) {
      const Residual residual = residualOf(pair, rig_, left_from_world, options_);
      if (residual.usable) residuals.push_back(residual);
    }
    return residuals;
  }

  /// docs/energy.md (27): the scale follows the median, so that half of the pairs always count.
  Vector6d stepFrom(const Eigen::Isometry3d& left_from_world) const {
    const std::vector<Residual> residuals = residualsAt(left_from_world);
    if (residuals.size() < 3) return Vector6d::Zero();
    std::vector<double> squares;
    for (const Residual& residual : residuals) squares.push_back(residual.value.squaredNorm());
    const double scale_sq =
        std::max(1.0, options_.robust_scale * options_.robust_scale * medianOf(squares));
    Matrix6d normal = Matrix6d::Zero();
    Vector6d right = Vector6d::Zero();
    for (const Residual& residual : residuals) {
      const double share = scale_sq / (scale_sq + residual.value.squaredNorm());
      normal += share * share * residual.slope.transpose() * residual.slope;
      right -= share * share * residual.slope.transpose() * residual.value;
    }
    const Vector6d twist = normal.ldlt().solve(right);
    return twist.allFinite() ? twist : Vector6d(Vector6d::Zero());
  }

  const std::vector<PosePair>& pairs_;
  const RectifiedRig& rig_;
  const RefinePoseOptions& options_;
};

}  // namespace

void RefinePoseOptions::validate() const {
  require(iterations >= 0, "pose.refine.iterations", iterations, "can't be negative");
  require(noise_px > 0, "pose.refine.noise_px", noise_px, "must be above 0");
  require(disparity_noise_px > 0, "pose.refine.disparity_noise_px", disparity_noise_px,
          "must be above 0");
  require(robust_scale > 0, "pose.refine.robust_scale", robust_scale, "must be above 0");
  require(standing_mm >= 0, "pose.refine.standing_mm", standing_mm, "can't be negative");
  require(moving_share >= 0 && moving_share <= 1, "pose.refine.moving_share", moving_share,
          "must be 0 to 1");
  require(standing_share >= 0 && standing_share <= 1, "pose.refine.standing_share", standing_share,
          "must be 0 to 1");
}

RefinedPose refinePose(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                       const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                       const RefinePoseOptions& options) {
  options.validate();
  const Pairs seen(pairs, rig, options);
  Eigen::Isometry3d best = seen.search(fitted.inverse());
  const Eigen::Isometry3d from_last = seen.search(last.inverse());
  if (seen.costAt(from_last) < seen.costAt(best)) best = from_last;
  RefinedPose refined;
  refined.moved_mm = seen.shiftMm(last.inverse());
  refined.left_mm = seen.shiftMm(best);
  const double explained = seen.explainedBy(best);
  const bool one_motion = explained >= options.moving_share &&
                          seen.explainedBy(last.inverse()) < kTellingShare * explained;
  refined.stands = refined.moved_mm < options.standing_mm &&
                   refined.left_mm > options.standing_share * refined.moved_mm && !one_motion;
  refined.world_from_left = refined.stands ? last : best.inverse();
  if (refined.stands) refined.disparity_offset_px = seen.disparityOffsetPx(last.inverse());
  return refined;
}

}  // namespace softscope
