// src/pose/ransac_pose.h: scope motion from matched points by RANSAC.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "pose/rigid_fit.h"

namespace softscope {

struct RansacOptions {
  double threshold_mm = 2.0;  // a pair with a larger distance is an outlier
  // that one trial drew inliers only; ends the search early
  static constexpr double kConfidence = 0.9999;
  static constexpr int kMaxTrials = 500;
  static constexpr int kRefits =
      2;  // fits to all inliers, each followed by a new selection of inliers
  static constexpr int kMinInliers = 12;       // fewer give no pose
  static constexpr double kMinShare = 0.2;     // of the usable pairs that must be inliers
  static constexpr double kMinSpreadMm = 0.5;  // of the inliers across their line, see PairFit
  std::uint32_t seed = 1;

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

struct RigidPose {
  bool found = false;
  std::string failure;  // reason, one line; empty if found
  /// p_target = target_from_source * p_source, mm; the identity if none was found.
  Eigen::Isometry3d target_from_source = Eigen::Isometry3d::Identity();
  std::vector<std::uint8_t> inlier;  // per pair, 1 = within the threshold; all 0 if not found
  int usable = 0;                    // finite pairs with a weight above 0
  int inliers = 0;
  double rms_mm = 0;  // of the inliers' distances, unweighted
  int trials = 0;
};

/// RANSAC (Fischler and Bolles) with a truncated quadratic score (MSAC), then refits
/// to all inliers. Same input, same result. Invalid pairs (not finite, weight not
/// above 0) are left out; without a solution found = false, never an exception.
/// Throws OptionError for invalid options and Error for vectors of different lengths.
RigidPose estimateRigidPose(const PointPairs& pairs, const RansacOptions& options);

}  // namespace softscope
