// eval/alignment/rigid_alignment.h: rigid or
// similarity transform between pairs of points.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace softscope {

struct RigidFit {
  Eigen::Isometry3d target_from_source = Eigen::Isometry3d::Identity();
  double rmse_mm = 0;   // of the pairs after the fit
  bool unique = false;  // false for collinear points: one rotation is undetermined
};

/// Least squares of |target - (R source + t)| over pairs of points, mm, without
/// scale and without reflection (Kabsch 1976, Umeyama 1991). Throws InputError for
/// unequal counts, fewer than three pairs, and coordinates that are not finite.
RigidFit fitRigid(const std::vector<Eigen::Vector3d>& source_mm,
                  const std::vector<Eigen::Vector3d>& target_mm);

/// p_target = scale * R * p_source + t.
struct SimilarityFit {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();
  double rmse_mm = 0;   // of the pairs after the fit
  bool unique = false;  // false if rotation or scale is undetermined
};

/// The same with a scale (Umeyama 1991, equation 42). Scale 1 if
/// all source points are equal. Throws InputError as fitRigid does.
SimilarityFit fitSimilarity(const std::vector<Eigen::Vector3d>& source_mm,
                            const std::vector<Eigen::Vector3d>& target_mm);

}  // namespace softscope
