#include "pose/rigid_fit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace softscope {

void PairSums::add(const Eigen::Vector3d& source_mm, const Eigen::Vector3d& target_mm,
                   double of_weight) {
  weight += of_weight;
  source += of_weight * source_mm;
  target += of_weight * target_mm;
  cross += of_weight * target_mm * source_mm.transpose();
  squares += of_weight * source_mm * source_mm.transpose();
}

PairFit fitPairs(const PairSums& sums) {
  PairFit fit;
  if (!(sums.weight > 0)) return fit;
  const Eigen::Vector3d source_mean = sums.source / sums.weight,
                        target_mean = sums.target / sums.weight;
  const Eigen::Matrix3d cross = sums.cross - sums.target * source_mean.transpose(),
                        squares = sums.squares - sums.source * source_mean.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, 1);
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  fit.target_from_source.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  fit.target_from_source.translation() =
      target_mean - fit.target_from_source.linear() * source_mean;
  const Eigen::Vector3d variances =
      Eigen::JacobiSVD<Eigen::Matrix3d>(squares / sums.weight).singularValues();
  fit.spread_mm = std::sqrt(std::max(variances.y(), 0.0));
  return fit;
}

}  // namespace softscope
