#include "pose/rigid_fit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace softscope {
namespace {

struct Moments {
  double weight = 0;
  Eigen::Vector3d source_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();   // target times source
  Eigen::Matrix3d source = Eigen::Matrix3d::Zero();  // source times source
};

Moments momentsOf(const PointPairs& pairs, const std::vector<int>& chosen) {
  Moments m;
  for (const int i : chosen) {
    const double w = pairs.weight(static_cast<std::size_t>(i));
    m.weight += w;
    m.source_mean += w * pairs.sources_mm[static_cast<std::size_t>(i)].cast<double>();
    m.target_mean += w * pairs.targets_mm[static_cast<std::size_t>(i)].cast<double>();
  }
  if (!(m.weight > 0)) return m;
  m.source_mean /= m.weight;
  m.target_mean /= m.weight;
  for (const int i : chosen) {
    const std::size_t k = static_cast<std::size_t>(i);
    const Eigen::Vector3d s = pairs.sources_mm[k].cast<double>() - m.source_mean;
    const Eigen::Vector3d t = pairs.targets_mm[k].cast<double>() - m.target_mean;
    m.cross += pairs.weight(k) * t * s.transpose();
    m.source += pairs.weight(k) * s * s.transpose();
  }
  return m;
}

}  // namespace

PairFit fitPairs(const PointPairs& pairs, const std::vector<int>& chosen) {
  PairFit fit;
  if (chosen.size() < 3) return fit;
  const Moments m = momentsOf(pairs, chosen);
  if (!(m.weight > 0)) return fit;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m.cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, 1);
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  fit.target_from_source.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  fit.target_from_source.translation() =
      m.target_mean - fit.target_from_source.linear() * m.source_mean;
  const Eigen::Vector3d variances =
      Eigen::JacobiSVD<Eigen::Matrix3d>(m.source / m.weight).singularValues();
  fit.spread_mm = std::sqrt(std::max(variances.y(), 0.0));
  return fit;
}

}  // namespace softscope
