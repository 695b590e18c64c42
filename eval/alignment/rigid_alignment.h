// eval/alignment/rigid_alignment.h: rotation, shift and, where asked for, scale that align pairs of
// points.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace softscope {

struct RigidFit {
  Eigen::Isometry3d target_from_source = Eigen::Isometry3d::Identity();
  double rmse_mm = 0;   // of the pairs after the fit
  bool unique = false;  // false where the pairs leave a rotation free: points on one line
};

/// Least squares of |target - (R source + t)| over pairs of points, mm, without scale and never a
/// reflection (Kabsch 1976, Umeyama 1991). Throws InputError for unequal counts, for fewer than
/// three pairs, and for coordinates that are not finite.
RigidFit fitRigid(const std::vector<Eigen::Vector3d>& source_mm,
                  const std::vector<Eigen::Vector3d>& target_mm);

/// p_target = scale * R * p_source + t.
struct SimilarityFit {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();
  double rmse_mm = 0;   // of the pairs after the fit
  bool unique = false;  // false where the pairs leave rotation or scale free
};

/// The same with a scale (Umeyama 1991, equation 42). Scale 1 where all sources are one point.
/// Throws InputError as fitRigid does.
SimilarityFit fitSimilarity(const std::vector<Eigen::Vector3d>& source_mm,
                            const std::vector<Eigen::Vector3d>& target_mm);

}  // namespace softscope
