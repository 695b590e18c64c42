// src/pose/rigid_fit.h: least-squares rigid transform between two point sets.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace softscope {

/// Points measured twice. All vectors have N elements; weights
/// may be empty (all 1), and are inverse variances. mm.
struct PointPairs {
  std::vector<Eigen::Vector3f> sources_mm;
  std::vector<Eigen::Vector3f> targets_mm;
  std::vector<float> weights;

  float weight(std::size_t i) const { return weights.empty() ? 1.0f : weights[i]; }
};

struct PairFit {
  Eigen::Isometry3d target_from_source = Eigen::Isometry3d::Identity();
  /// Weighted standard deviation of the sources across their best line, mm; near
  /// 0, the points are collinear and the rotation about the line is arbitrary.
  double spread_mm = 0;
};

/// Least squares in closed form (Kabsch 1976, Horn 1987) over the selected pairs; never
/// a reflection. Fewer than three pairs, or no weight, give the identity and no spread.
PairFit fitPairs(const PointPairs& pairs, const std::vector<int>& chosen);

}  // namespace softscope
