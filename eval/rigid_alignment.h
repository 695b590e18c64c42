// eval/rigid_alignment.h: the rotation and shift that bring points onto their partners.
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

}  // namespace softscope
