// eval/simulation/tissue/arap_pushes.cpp: local
// rotations by SVD, global positions by a sparse solve.
#include "eval/simulation/tissue/arap_pushes.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kIterations = 6;   // local and global steps; later ones have little effect
constexpr double kTipHold = 30;  // stiffness at the centre of the tip, in units of the springs
constexpr double kSixNeighbours = 1.5;  // a regular mesh's Laplacian is 1.5 edge^2 times

std::vector<std::vector<std::int32_t>> neighboursOf(const TriangleMesh& mesh) {
  std::vector<std::vector<std::int32_t>> neighbours(mesh.vertices_mm.size());
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      for (const int other : {t[(i + 1) % 3], t[(i + 2) % 3]}) neighbours[t[i]].push_back(other);
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& covariance) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d v = svd.matrixV();
  if ((v * svd.matrixU().transpose()).determinant() < 0) v.col(2) *= -1;
  return v * svd.matrixU().transpose();
}

}  // namespace

ArapPushes::ArapPushes(const TriangleMesh& rest_mesh, double spread_mm)
    : spread_mm_(spread_mm),
      neighbours_(neighboursOf(rest_mesh)),
      rotations_(rest_mesh.vertices_mm.size(), Eigen::Matrix3d::Identity()) {
  double edges2_mm2 = 0, edges = 0;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < neighbours_.size(); ++i)
    for (const std::int32_t j : neighbours_[i]) {
      edges2_mm2 += (rest_mesh.vertices_mm[i] - rest_mesh.vertices_mm[j]).squaredNorm();
      ++edges;
      entries.emplace_back(int(i), int(i), 1);
      entries.emplace_back(int(i), j, -1);
    }
  bed_ = kSixNeighbours * edges2_mm2 / std::max(1.0, edges) / (spread_mm * spread_mm);
  const auto n = static_cast<int>(neighbours_.size());
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, bed_);
  springs_.resize(n, n);
  springs_.setFromTriplets(entries.begin(), entries.end());
}

/// (1 - (d / r)^2)^2 within the tip, smooth at its border.
Eigen::VectorXd ArapPushes::tipWeights(const Points& last_mm, int vertex) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(last_mm.rows());
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const double share = (last_mm.row(i) - last_mm.row(vertex)).norm() / spread_mm_;
    if (share < 1) weights[i] = kTipHold * std::pow(1 - share * share, 2);
  }
  return weights;
}

void ArapPushes::fitRotations(const Points& last_mm, const Points& now_mm) {
  parallelRanges(static_cast<int>(rotations_.size()), 512, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
      for (const std::int32_t j : neighbours_[i])
        covariance +=
            (last_mm.row(i) - last_mm.row(j)).transpose() * (now_mm.row(i) - now_mm.row(j));
      rotations_[i] = nearestRotation(covariance);
    }
  });
}

/// Force of the rotated edges on each vertex.
ArapPushes::Points ArapPushes::edgeForces(const Points& last_mm) const {
  Points forces = Points::Zero(last_mm.rows(), 3);
  for (std::size_t i = 0; i < neighbours_.size(); ++i)
    for (const std::int32_t j : neighbours_[i]) {
      const Eigen::RowVector3d edge = last_mm.row(Eigen::Index(i)) - last_mm.row(j);
      forces.row(Eigen::Index(i)) +=
          0.5 * edge * (rotations_[i] + rotations_[std::size_t(j)]).transpose();
    }
  return forces;
}

std::vector<Eigen::Vector3f> ArapPushes::push(const std::vector<Eigen::Vector3f>& last_mm,
                                              int vertex, const Eigen::Vector3d& shift_mm) {
  Points last(static_cast<Eigen::Index>(last_mm.size()), 3);
  for (std::size_t i = 0; i < last_mm.size(); ++i)
    last.row(Eigen::Index(i)) = last_mm[i].cast<double>().transpose();
  const Eigen::VectorXd tip = tipWeights(last, vertex);
  Matrix system = springs_;
  system.diagonal() += tip;
  if (!solver_) {
    solver_ = std::make_unique<Eigen::SimplicialLDLT<Matrix>>();
    solver_->analyzePattern(system);
  }
  solver_->factorize(system);
  const Points held = bed_ * last + tip.asDiagonal() * (last.rowwise() + shift_mm.transpose());
  Points now = last;
  std::fill(rotations_.begin(), rotations_.end(), Eigen::Matrix3d::Identity());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (iteration > 0) fitRotations(last, now);
    now = solver_->solve(held + edgeForces(last));
  }
  std::vector<Eigen::Vector3f> state;
  state.reserve(last_mm.size());
  for (Eigen::Index i = 0; i < now.rows(); ++i)
    state.push_back(now.row(i).transpose().cast<float>());
  return state;
}

}  // namespace softscope
