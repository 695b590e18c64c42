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

/// Weighted sums over pairs, of coordinates from the origin: at 100 mm they leave 1e-11 mm².
struct PairSums {
  double weight = 0;
  Eigen::Vector3d source = Eigen::Vector3d::Zero(), target = Eigen::Vector3d::Zero();
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();    // target times source
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  // source times source

  void add(const Eigen::Vector3d& source_mm, const Eigen::Vector3d& target_mm, double of_weight);
};

struct PairFit {
  Eigen::Isometry3d target_from_source = Eigen::Isometry3d::Identity();
  /// Weighted standard deviation of the sources across their best line, mm; near
  /// 0, the points are collinear and the rotation about the line is arbitrary.
  double spread_mm = 0;
};

/// Least squares in closed form (Kabsch 1976, Horn 1987); never a reflection.
/// No weight gives the identity and no spread.
PairFit fitPairs(const PairSums& sums);

}  // namespace softscope
