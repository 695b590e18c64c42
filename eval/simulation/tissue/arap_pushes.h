// eval/simulation/tissue/arap_pushes.h: persistent pushes, spread through the tissue as rigidly as
// possible (ARAP).
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Tissue on an elastic bed. A push moves the surroundings of one vertex from where the last push
/// left them; the rest follows by minimising, over positions p and a rotation R_i a vertex,
///   sum_edges |p_i - p_j - R_i (l_i - l_j)|^2 + a sum_i |p_i - l_i|^2 + sum_tip b_i |p_i - l_i -
///   s|^2
/// with l the last state and s the push (Sorkine and Alexa 2007; the paper's own simulation).
class ArapPushes {
 public:
  /// `spread_mm`: radius of what pushes, whose hold fades to 0 at its rim; beyond, tissue gives in
  /// over about the same length. So 0.6 of the push is left at this distance, as with a Gaussian.
  ArapPushes(const TriangleMesh& rest_mesh, double spread_mm);

  /// The state after one more push, `last_mm` being the state before. The same bytes on any number
  /// of threads.
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
  Matrix springs_;  // graph Laplacian, and the bed on its diagonal
  double bed_ = 0;
  std::vector<Eigen::Matrix3d> rotations_;
  std::unique_ptr<Eigen::SimplicialLDLT<Matrix>> solver_;  // its ordering holds for all pushes
};

}  // namespace softscope
