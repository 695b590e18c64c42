// eval/alignment/rigid_alignment.cpp: closed form by singular value decomposition.
#include "eval/alignment/rigid_alignment.h"

#include <Eigen/SVD>
#include <cmath>
#include <string>

#include "core/error.h"

namespace softscope {
namespace {

using Points = std::vector<Eigen::Vector3d>;

void check(const Points& source_mm, const Points& target_mm) {
  if (source_mm.size() != target_mm.size())
    throw InputError("a rigid fit got " + std::to_string(source_mm.size()) + " points and " +
                     std::to_string(target_mm.size()) + " partners; give one partner per point");
  if (source_mm.size() < 3)
    throw InputError("a rigid fit got " + std::to_string(source_mm.size()) +
                     " pairs of points, but it takes three or more");
  for (std::size_t i = 0; i < source_mm.size(); ++i)
    if (!source_mm[i].allFinite() || !target_mm[i].allFinite())
      throw InputError("pair " + std::to_string(i) +
                       " of a rigid fit is not finite; leave such pairs out");
}

Eigen::Vector3d meanOf(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Rotation that maximises trace(R^T covariance), with the properties of the solution.
struct Turn {
  Eigen::Matrix3d rotation;
  double trace = 0;  // of the singular values, the last one with its sign
  bool unique = false;
};

/// `covariance`: sum of (target - mean) (source - mean)^T.
Turn turnOf(const Eigen::Matrix3d& covariance) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Vector3d signs(1, 1, sign);
  return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(),
          svd.singularValues().dot(signs),
          svd.singularValues()[1] > 1e-12 * svd.singularValues()[0]};
}

Eigen::Matrix3d covarianceOf(const Points& source_mm, const Eigen::Vector3d& source_mean,
                             const Points& target_mm, const Eigen::Vector3d& target_mean) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source_mm.size(); ++i)
    covariance += (target_mm[i] - target_mean) * (source_mm[i] - source_mean).transpose();
  return covariance;
}

}  // namespace

RigidFit fitRigid(const Points& source_mm, const Points& target_mm) {
  check(source_mm, target_mm);
  const Eigen::Vector3d source_mean = meanOf(source_mm), target_mean = meanOf(target_mm);
  const Turn turn = turnOf(covarianceOf(source_mm, source_mean, target_mm, target_mean));
  RigidFit fit;
  fit.target_from_source.linear() = turn.rotation;
  fit.target_from_source.translation() =
      target_mean - fit.target_from_source.linear() * source_mean;
  fit.unique = turn.unique;

  double squares = 0;
  for (std::size_t i = 0; i < source_mm.size(); ++i)
    squares += (target_mm[i] - fit.target_from_source * source_mm[i]).squaredNorm();
  fit.rmse_mm = std::sqrt(squares / static_cast<double>(source_mm.size()));
  return fit;
}

SimilarityFit fitSimilarity(const Points& source_mm, const Points& target_mm) {
  check(source_mm, target_mm);
  const Eigen::Vector3d source_mean = meanOf(source_mm), target_mean = meanOf(target_mm);
  const Turn turn = turnOf(covarianceOf(source_mm, source_mean, target_mm, target_mean));
  double source_squares = 0;
  for (const Eigen::Vector3d& p : source_mm) source_squares += (p - source_mean).squaredNorm();
  SimilarityFit fit;
  fit.rotation = turn.rotation;
  if (source_squares > 0) fit.scale = turn.trace / source_squares;
  fit.translation_mm = target_mean - fit.scale * (fit.rotation * source_mean);
  fit.unique = turn.unique && source_squares > 0;

  double squares = 0;
  for (std::size_t i = 0; i < source_mm.size(); ++i)
    squares += (target_mm[i] - (fit.scale * (fit.rotation * source_mm[i]) + fit.translation_mm))
                   .squaredNorm();
  fit.rmse_mm = std::sqrt(squares / static_cast<double>(source_mm.size()));
  return fit;
}

}  // namespace softscope
