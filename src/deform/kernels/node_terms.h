// src/deform/kernels/node_terms.h: unknowns of a node, and its rotation and rest terms.
//
// Eigen of fixed size only, so that the GPU compiles it too.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/hd.h"
#include "core/warp_graph.h"
#include "deform/kernels/deform_kernels.h"

namespace softscope {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// [a]x, so that [a]x b = a x b.
SOFTSCOPE_HD inline Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Rotation by |omega| about omega: docs/energy.md (3).
SOFTSCOPE_HD inline Eigen::Quaterniond rotationOf(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const double half_sinc = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5;
  Eigen::Quaterniond q(std::cos(angle / 2), half_sinc * omega.x(), half_sinc * omega.y(),
                       half_sinc * omega.z());
  return q.normalized();
}

/// Six unknowns: a twist (omega, delta t), applied from the left: docs/energy.md (3).
struct RigidNode {
  static constexpr int kUnknowns = 6;
  using Jacobian = Eigen::Matrix<double, 3, kUnknowns>;

  SOFTSCOPE_HD static void apply(const double* step, NodeTransform* transform) {
    const Eigen::Vector3d omega(step[0], step[1], step[2]);
    const Eigen::Quaterniond rotation = rotationOf(omega) * Eigen::Quaterniond(transform->linear);
    transform->linear = rotation.normalized().toRotationMatrix();
    transform->translation_mm += Eigen::Vector3d(step[3], step[4], step[5]);
  }

  /// d (A d + t) / d unknowns.
  SOFTSCOPE_HD static Jacobian leverJacobian(const NodeTransform& transform,
                                             const Eigen::Vector3d& offset_mm) {
    Jacobian j;
    j.leftCols<3>() = -crossMatrix(transform.linear * offset_mm);
    j.rightCols<3>().setIdentity();
    return j;
  }
};

/// Twelve unknowns: increments of A, column by column, and of t.
struct AffineNode {
  static constexpr int kUnknowns = 12;
  using Jacobian = Eigen::Matrix<double, 3, kUnknowns>;

  SOFTSCOPE_HD static void apply(const double* step, NodeTransform* transform) {
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) transform->linear(r, c) += step[3 * c + r];
    transform->translation_mm += Eigen::Vector3d(step[9], step[10], step[11]);
  }

  SOFTSCOPE_HD static Jacobian leverJacobian(const NodeTransform&,
                                             const Eigen::Vector3d& offset_mm) {
    Jacobian j;
    for (int c = 0; c < 3; ++c) j.middleCols<3>(3 * c) = offset_mm[c] * Eigen::Matrix3d::Identity();
    j.rightCols<3>().setIdentity();
    return j;
  }
};

/// Difference between `other` and its expected position, mm:
/// docs/energy.md (6). `expected_mm`: expected offset before rotation.
SOFTSCOPE_HD inline Eigen::Vector3d edgeResidual(const Eigen::Vector3d& own_mm,
                                                 const NodeTransform& own,
                                                 const Eigen::Vector3d& other_mm,
                                                 const NodeTransform& other,
                                                 const Eigen::Vector3d& expected_mm) {
  return own.linear * expected_mm - (other_mm - own_mm) + own.translation_mm - other.translation_mm;
}

/// Deviation of A from a rotation: three products of columns,
/// three squared lengths less one: docs/energy.md (5).
SOFTSCOPE_HD inline Vector6d rotationResidual(const Eigen::Matrix3d& linear) {
  const Eigen::Vector3d a = linear.col(0), b = linear.col(1), c = linear.col(2);
  Vector6d r;
  r << a.dot(b), a.dot(c), b.dot(c), a.dot(a) - 1, b.dot(b) - 1, c.dot(c) - 1;
  return r;
}

/// d rotationResidual / d (A column by column, t): docs/energy.md (23).
SOFTSCOPE_HD inline Eigen::Matrix<double, 6, 12> rotationJacobian(const Eigen::Matrix3d& linear) {
  const Eigen::RowVector3d a = linear.col(0).transpose(), b = linear.col(1).transpose(),
                           c = linear.col(2).transpose();
  Eigen::Matrix<double, 6, 12> j = Eigen::Matrix<double, 6, 12>::Zero();
  j.block<1, 3>(0, 0) = b;
  j.block<1, 3>(0, 3) = a;
  j.block<1, 3>(1, 0) = c;
  j.block<1, 3>(1, 6) = a;
  j.block<1, 3>(2, 3) = c;
  j.block<1, 3>(2, 6) = b;
  j.block<1, 3>(3, 0) = 2 * a;
  j.block<1, 3>(4, 3) = 2 * b;
  j.block<1, 3>(5, 6) = 2 * c;
  return j;
}

/// Float copy for warping points: docs/energy.md (2).
SOFTSCOPE_HD inline PackedNode packNode(const Eigen::Vector3d& rest_mm,
                                        const NodeTransform& transform) {
  PackedNode packed;
  Eigen::Map<Eigen::Matrix4f> columns(packed.values);
  columns.setZero();
  columns.topLeftCorner<3, 3>() = (transform.linear - Eigen::Matrix3d::Identity()).cast<float>();
  columns.topRightCorner<3, 1>() =
      (rest_mm + transform.translation_mm - transform.linear * rest_mm).cast<float>();
  return packed;
}

/// alpha of an edge: docs/energy.md (7). Depends on
/// strain, not length: (spacing / length)^2, at most 4.
SOFTSCOPE_HD inline double edgeWeight(double length_mm, double spacing_mm) {
  const double length = length_mm > spacing_mm / 2 ? length_mm : spacing_mm / 2;
  return spacing_mm * spacing_mm / (length * length);
}

}  // namespace softscope
