// eval/simulation/tissue/arap_pushes.h: persistent
// pushes, propagated as rigidly as possible (ARAP).
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Tissue on an elastic bed. A push displaces the neighbourhood of one vertex
/// from the state after the last push; the other positions p and a rotation
/// R_i per vertex minimise sum_edges |p_i - p_j - R_i (l_i - l_j)|^2 + a sum_i
/// |p_i - l_i|^2 + sum_tip b_i |p_i - l_i - s|^2 with l the last state and s
/// the push (Sorkine and Alexa 2007; as in the simulation of the paper).
class ArapPushes {
 public:
  /// `spread_mm`: radius of the tip, whose stiffness falls to 0 at its border; outside, the
  /// displacement falls over about this length: 0.6 of the push here, as for a Gaussian.
  ArapPushes(const TriangleMesh& rest_mesh, double spread_mm);

  /// State after one more push from `last_mm`.
  /// Deterministic on any number of threads.
  std::vector<Eigen::Vector3f> push(const std::vector<Eigen::Vector3f>& last_mm, int vertex,
                                    const Eigen::Vector3d& shift_mm);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  Eigen::VectorXd tipWeights(const Points& last_mm, int vertex) const;
  void fitRotations(const Points& last_mm, const Points& now_mm);
  Points edgeForces(const Points& last_mm) const;

  double spread_mm_;
  std::vector<std::vector<std::int32_t>> neighbours_;
  Matrix springs_;  // graph Laplacian, with the bed on its diagonal
  double bed_ = 0;
  std::vector<Eigen::Matrix3d> rotations_;
  std::unique_ptr<Eigen::SimplicialLDLT<Matrix>> solver_;  // one ordering for all pushes
};

}  // namespace softscope
