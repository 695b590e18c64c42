// tests/deform/test_jacobians.cpp: every analytic Jacobian against central differences.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "deform/kernels/node_terms.h"
#include "deform/kernels/plane_term.h"

namespace softscope {
namespace {

constexpr double kTolerance = 1e-5;  // relative; central differences with h = 1e-5 reach 1e-9
constexpr double kStep = 1e-5;

using Residual = std::function<Eigen::VectorXd(const NodeTransform&)>;

/// d residual / d unknowns of one node by central differences.
template <class Node>
Eigen::MatrixXd differences(const NodeTransform& at, const Residual& residual) {
  Eigen::MatrixXd jacobian(residual(at).size(), Node::kUnknowns);
  for (int a = 0; a < Node::kUnknowns; ++a) {
    Eigen::Matrix<double, Node::kUnknowns, 1> step = step.Zero();
    NodeTransform up = at, down = at;
    step[a] = kStep;
    Node::apply(step.data(), &up);
    step[a] = -kStep;
    Node::apply(step.data(), &down);
    jacobian.col(a) = (residual(up) - residual(down)) / (2 * kStep);
  }
  return jacobian;
}

void expectClose(const Eigen::MatrixXd& found, const Eigen::MatrixXd& truth) {
  ASSERT_EQ(found.rows(), truth.rows());
  ASSERT_EQ(found.cols(), truth.cols());
  EXPECT_LT((found - truth).norm(), kTolerance * truth.norm());
}

class Jacobians : public ::testing::TestWithParam<int> {
 protected:
  Jacobians() : random_(static_cast<unsigned>(GetParam())) {}

  Eigen::Vector3d vector(double size) {
    std::uniform_real_distribution<double> value(-size, size);
    return {value(random_), value(random_), value(random_)};
  }
  NodeTransform rotated() { return {rotationOf(vector(0.8)).toRotationMatrix(), vector(2.0)}; }
  NodeTransform sheared() {
    NodeTransform transform = rotated();
    for (int c = 0; c < 3; ++c) transform.linear.col(c) += vector(0.3);
    return transform;
  }
  static Vec3<double> raw(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

  std::mt19937 random_;
};

TEST_P(Jacobians, RigidPointToPlane) {
  const NodeTransform node = rotated();
  const Eigen::Vector3d offset = vector(5), normal = vector(1).normalized();
  const double weight = 0.37;
  double row[6];
  rigidPlaneRow(raw(node.linear * offset), raw(normal), weight, row);

  const Residual residual = [&](const NodeTransform& at) {
    return Eigen::VectorXd::Constant(1,
                                     weight * normal.dot(at.linear * offset + at.translation_mm));
  };

  expectClose(Eigen::Map<Eigen::RowVectorXd>(row, 6), differences<RigidNode>(node, residual));
}

TEST_P(Jacobians, AffinePointToPlane) {
  const NodeTransform node = sheared();
  const Eigen::Vector3d offset = vector(5), normal = vector(1).normalized();
  const double weight = 0.37;
  double row[12];
  affinePlaneRow(raw(offset), raw(normal), weight, row);

  const Residual residual = [&](const NodeTransform& at) {
    return Eigen::VectorXd::Constant(1,
                                     weight * normal.dot(at.linear * offset + at.translation_mm));
  };

  expectClose(Eigen::Map<Eigen::RowVectorXd>(row, 12), differences<AffineNode>(node, residual));
}

TEST_P(Jacobians, ResidualOfAPlaneIsTheSumOfItsNodesShares) {
  const Eigen::Vector3d point = vector(3), target = vector(3), normal = vector(1).normalized();
  const double weights[2] = {0.3, 0.7};
  Eigen::Vector3d warped = Eigen::Vector3d::Zero();
  double shares = 0;
  for (const double weight : weights) {
    const NodeTransform node = sheared();
    const Eigen::Vector3d g = vector(4);
    warped += weight * warpByNode(node, g, point);
    shares += planeShare(raw(node.linear * (point - g)), raw(g + node.translation_mm), raw(target),
                         raw(normal), weight);
  }
  EXPECT_NEAR(shares, normal.dot(warped - target), 1e-12);  // rounding of numbers near 10
}

template <class Node>
void expectEdgeJacobians(const NodeTransform& own, const NodeTransform& other,
                         const Eigen::Vector3d& own_mm, const Eigen::Vector3d& other_mm,
                         const Eigen::Vector3d& expected_mm) {
  const Residual as_own = [&](const NodeTransform& at) -> Eigen::VectorXd {
    return edgeResidual(own_mm, at, other_mm, other, expected_mm);
  };
  expectClose(Node::leverJacobian(own, expected_mm), differences<Node>(own, as_own));

  const Residual as_other = [&](const NodeTransform& at) -> Eigen::VectorXd {
    return edgeResidual(own_mm, own, other_mm, at, expected_mm);
  };
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, Node::kUnknowns);
  expected.rightCols<3>() = -Eigen::Matrix3d::Identity();  // what EdgeSystem assumes
  expectClose(expected, differences<Node>(other, as_other));
}

TEST_P(Jacobians, RigidEdge) {
  expectEdgeJacobians<RigidNode>(rotated(), rotated(), vector(5), vector(5), vector(5));
}

TEST_P(Jacobians, AffineEdge) {
  expectEdgeJacobians<AffineNode>(sheared(), sheared(), vector(5), vector(5), vector(5));
}

TEST_P(Jacobians, Rotation) {
  const NodeTransform node = sheared();
  const Residual residual = [](const NodeTransform& at) -> Eigen::VectorXd {
    return rotationResidual(at.linear);
  };
  expectClose(rotationJacobian(node.linear), differences<AffineNode>(node, residual));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Jacobians, ::testing::Range(1, 6));

TEST(RotationOf, KeepsLengthsForTinyAndLargeTurns) {
  for (const double angle : {0.0, 1e-12, 1e-6, 0.1, 3.0, 40.0}) {
    const Eigen::Matrix3d r = rotationOf(angle * Eigen::Vector3d(0.6, 0, 0.8)).toRotationMatrix();
    EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-14) << angle;
    EXPECT_GT(r.determinant(), 0) << angle;
  }
}

}  // namespace
}  // namespace softscope
