// tests/deform/test_energy.cpp: energies by hand, and normal equations against plain sums.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "deform/cholesky/block_pattern.h"
#include "deform/energy/energy.h"
#include "deform/energy/node_sight.h"
#include "deform/energy/robust_loss.h"
#include "deform/kernels/node_terms.h"
#include "deform/solver/normal_equations.h"
#include "scenes.h"

namespace softscope {
namespace {

/// One node at the origin, one at (4, 0, 0), one point at (1, 0, 0) that both carry.
struct TwoNodes {
  PointModel model;
  WarpGraph graph;

  TwoNodes() {
    graph.positions_mm = {{0, 0, 0}, {4, 0, 0}};
    graph.transforms.resize(2);
    graph.edges = {{0, 1, 1.0}};
    graph.stencils = {{0, 1, 1, 1}};
    model.add({1, 0, 0}, {0, 0, -1}, {}, 1);
    model.bindings[0] = {0, {0.75f, 0.25f, 0, 0}};
  }

  EnergyTerms energy(const DeformOptions& options, const std::vector<KeyPointMatch>& matches) {
    CandidatePoints none;
    none.stencil_start.assign(2, 0);
    ConstraintSet constraints;
    makeConstraints(model, graph, none, CarriedMatches(model, graph, matches),
                    options.correspondence_weight, &constraints);
    EnergyValue value;
    evaluateEnergy(graph, constraints, options, &value);
    return value.terms;
  }
};

DeformOptions unitWeights(NodeModel model) {
  DeformOptions options;
  options.node_model = model;
  options.rotation_weight = options.regularisation_weight = 1;
  options.data_weight = options.correspondence_weight = 1;
  options.data_robust.loss = options.correspondence_robust.loss = RobustLoss::kNone;
  return options;
}

TEST(Energy, IsZeroWhereNothingMoved) {
  TwoNodes scene;
  EXPECT_EQ(scene.energy(unitWeights(NodeModel::kAffine), {}).total(), 0);
}

TEST(Energy, OfStretchedEdgeByHand) {
  TwoNodes scene;
  scene.graph.transforms[1].translation_mm = {0.5, 0, 0};
  // Each node finds the other half a millimetre off: 2 * 0.25.
  EXPECT_DOUBLE_EQ(scene.energy(unitWeights(NodeModel::kRigid), {}).regularisation, 0.5);
  scene.graph.edges[0].weight = 3;
  EXPECT_DOUBLE_EQ(scene.energy(unitWeights(NodeModel::kRigid), {}).regularisation, 1.5);
}

TEST(Energy, OfARigidMotionIsOnlyItsMisfit) {
  TwoNodes scene;
  const Eigen::Matrix3d turn = rotationOf({0, 0, 0.4}).toRotationMatrix();
  for (int j = 0; j < 2; ++j) {
    scene.graph.transforms[j].linear = turn;
    scene.graph.transforms[j].translation_mm =
        turn * scene.graph.positions_mm[j] - scene.graph.positions_mm[j];
  }
  const EnergyTerms terms = scene.energy(unitWeights(NodeModel::kAffine), {});
  EXPECT_LT(terms.regularisation, 1e-28);  // rounding, squared
  EXPECT_LT(terms.rotation, 1e-28);
}

TEST(Energy, OfHiddenNodesThatMoveByHand) {
  TwoNodes scene;
  scene.graph.transforms[0].translation_mm = {1, 2, 2};
  scene.graph.transforms[1].translation_mm = {0, 0, 3};
  ConstraintSet constraints;
  constraints.stiffness = {0};
  constraints.expected.resize(1);
  constraints.hidden = {0.5, 1};
  DeformOptions options = unitWeights(NodeModel::kRigid);
  options.rest_weight = 2;
  EnergyValue value;
  evaluateEnergy(scene.graph, constraints, options, &value);
  EXPECT_DOUBLE_EQ(value.terms.rest, 2 * (0.5 * 9 + 9));
}

TEST(Energy, OfAStretchedMatrixByHand) {
  TwoNodes scene;
  scene.graph.transforms[0].linear = Eigen::Vector3d(2, 1, 1).asDiagonal();
  const EnergyTerms terms = scene.energy(unitWeights(NodeModel::kAffine), {});
  EXPECT_DOUBLE_EQ(terms.rotation, 9);         // (2 * 2 - 1)^2
  EXPECT_DOUBLE_EQ(terms.regularisation, 16);  // node 1 expected at (8, 0, 0)
}

TEST(Energy, OfAMatchByHand) {
  TwoNodes scene;
  scene.graph.transforms[1].translation_mm = {0, 0, 2};  // carries the point up by 0.25 * 2
  KeyPointMatch match;
  match.model_point = 0;
  match.source_mm = {1, 0, 0};
  match.target_mm = {1, 0, 1};
  const DeformOptions options = unitWeights(NodeModel::kRigid);
  EXPECT_DOUBLE_EQ(scene.energy(options, {match}).correspondence, 0.25);
  match.sqrt_information = 2 * Eigen::Matrix3f::Identity();
  EXPECT_DOUBLE_EQ(scene.energy(options, {match}).correspondence, 1.0);
}

TEST(MatchSqrtInformation, WeighsAlongTheRayAndAcrossIt) {
  const Eigen::Vector3f ray(0, 0.6f, 0.8f), across(1, 0, 0);
  const Eigen::Matrix3f root = matchSqrtInformation(ray, 0.3, 0.05, 0.15);
  EXPECT_LT((root * ray - 0.5f * ray).norm(), 1e-6f);        // 0.15 / 0.3
  EXPECT_LT((root * across - 3.0f * across).norm(), 1e-6f);  // 0.15 / 0.05
}

TEST(RobustLoss, AgreesWithSquaresInsideAndBoundsOutside) {
  const RobustOptions huber{RobustLoss::kHuber, 2.0};
  EXPECT_DOUBLE_EQ(robustValue(huber, 4.0).cost, 4.0);
  EXPECT_DOUBLE_EQ(robustValue(huber, 9.0).cost, 2 * 2 * 3 - 4);
  EXPECT_DOUBLE_EQ(robustValue(huber, 9.0).weight, 2.0 / 3);
}

TEST(RobustLoss, WeightIsTheSlopeOfTheCost) {
  const double h = 1e-6;
  for (const RobustLoss loss : {RobustLoss::kNone, RobustLoss::kHuber})
    for (const double squared : {0.1, 0.9, 3.0, 7.0}) {
      const RobustOptions robust{loss, 1.5};
      const double slope =
          (robustValue(robust, squared + h).cost - robustValue(robust, squared - h).cost) / (2 * h);
      EXPECT_NEAR(robustValue(robust, squared).weight, slope, 1e-7);
    }
}

/// A bent hill with targets and matches, away from its optimum.
struct BentHill {
  PointModel model = scenes::makeHill(24, 20, 0.6);
  WarpGraph graph = scenes::bindGraph(&model);
  ConstraintSet constraints;
  EnergyValue value;

  explicit BentHill(const DeformOptions& options) {
    const auto view =
        scenes::renderHill(scenes::makeCamera(90, 80, 200), scenes::smoothBend, 24, 20);
    const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                             options.association);
    CandidatePoints candidates;
    collectCandidates(model, graph, nullptr, 0, &candidates);
    const std::vector<KeyPointMatch> matches = scenes::makeMatches(model, scenes::smoothBend, 37);
    makeConstraints(model, graph, candidates, CarriedMatches(model, graph, matches),
                    options.correspondence_weight, &constraints);
    for (std::size_t j = 0; j < graph.size(); ++j) {
      const double s = static_cast<double>(j);
      graph.transforms[j].linear =
          rotationOf({0.01 * std::sin(s), 0.02 * std::cos(2 * s), 0.01}).toRotationMatrix();
      graph.transforms[j].translation_mm = {0.1 * std::cos(s), 0.1, 0.05 * std::sin(3 * s)};
      if (options.node_model == NodeModel::kAffine)
        graph.transforms[j].linear(0, 1) += 0.02 * std::sin(5 * s);
    }
    associate(graph, candidates, &target, options.data_weight, &constraints);
    constraints.hidden.resize(graph.size());
    for (std::size_t j = 0; j < graph.size(); ++j)
      constraints.hidden[j] = 1 / (1.0 + static_cast<double>(j % 3));
    for (std::size_t e = 0; e < constraints.stiffness.size(); ++e)
      constraints.stiffness[e] = 1 / (1.0 + static_cast<double>(e % 5));
    for (ExpectedOffsets& expected : constraints.expected) {
      expected.from_first_mm *= 1.1;
      expected.from_second_mm *= 0.8;
    }
    evaluateEnergy(graph, constraints, options, &value);
  }
};

TEST(NodeSight, StiffensAndHoldsWhatHides) {
  PointModel model = scenes::makeHill(24, 20, 0.6);
  const WarpGraph graph = scenes::bindGraph(&model);
  const auto judged = [&](const std::vector<int>* visible) {
    CandidatePoints candidates;
    collectCandidates(model, graph, visible, 0, &candidates);
    ConstraintSet constraints;
    constraints.stiffness.assign(graph.edges.size(), 1);
    classifyNodes(model, graph, candidates, 0.2, &constraints);
    return constraints;
  };
  const std::vector<int> nothing;
  for (const double one : judged(&nothing).stiffness) EXPECT_EQ(one, 1);
  for (const double one : judged(&nothing).hidden) EXPECT_EQ(one, 1);
  for (const double one : judged(nullptr).stiffness) EXPECT_NEAR(one, 0.2, 1e-9);
  for (const double one : judged(nullptr).hidden) EXPECT_NEAR(one, 0, 1e-9);
  std::vector<int> left;
  for (std::size_t i = 0; i < model.size(); ++i)
    if (model.positions_mm[i].x() < 0) left.push_back(static_cast<int>(i));
  const std::vector<double> half = judged(&left).stiffness;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const double x = std::max(graph.positions_mm[graph.edges[e].first].x(),
                              graph.positions_mm[graph.edges[e].second].x());
    if (x > 8) {  // two spacings into the dark
      EXPECT_EQ(half[e], 1);
    }
    if (x < -8) {  // two spacings into the light
      EXPECT_NEAR(half[e], 0.2, 1e-9);
    }
  }
}

DeformOptions testOptions(NodeModel model, RobustLoss loss) {
  DeformOptions options = unitWeights(model);
  options.rotation_weight = 10;
  options.regularisation_weight = 7;
  options.rest_weight = 5;
  options.correspondence_weight = 3;
  options.data_robust = {loss, 0.4};
  options.correspondence_robust = {loss, 0.7};
  return options;
}

/// Half the slope of the energy along one unknown, by central differences.
template <class Node>
double halfSlope(const BentHill& scene, const DeformOptions& options, int node, int unknown) {
  const double h = 1e-5;
  double energies[2];
  for (const int side : {0, 1}) {
    WarpGraph graph = scene.graph;
    double step[Node::kUnknowns] = {};
    step[unknown] = side == 0 ? -h : h;
    Node::apply(step, &graph.transforms[node]);
    EnergyValue value;
    evaluateEnergy(graph, scene.constraints, options, &value);
    energies[side] = value.terms.total();
  }
  return (energies[1] - energies[0]) / (4 * h);
}

template <class Node>
void expectGradient(NodeModel model, RobustLoss loss) {
  const DeformOptions options = testOptions(model, loss);
  BentHill scene(options);
  ASSERT_GT(scene.constraints.points, 500);
  ASSERT_GT(scene.constraints.matches, 20);
  NormalEquations<Node> equations;
  equations.analyse(scene.graph, makeBlockPattern(scene.graph));
  equations.assemble(scene.graph, scene.constraints, scene.value, options);
  Eigen::VectorXd truth(equations.gradient().size());
  for (Eigen::Index i = 0; i < truth.size(); ++i)
    truth[i] = halfSlope<Node>(scene, options, static_cast<int>(i / Node::kUnknowns),
                               static_cast<int>(i % Node::kUnknowns));
  EXPECT_LT((equations.gradient() - truth).norm(), 1e-5 * truth.norm());
}

TEST(NormalEquations, GradientIsTheSlopeOfTheEnergyForRigidNodes) {
  for (const RobustLoss loss : {RobustLoss::kNone, RobustLoss::kHuber})
    expectGradient<RigidNode>(NodeModel::kRigid, loss);
}

TEST(NormalEquations, GradientIsTheSlopeOfTheEnergyForAffineNodes) {
  for (const RobustLoss loss : {RobustLoss::kNone, RobustLoss::kHuber})
    expectGradient<AffineNode>(NodeModel::kAffine, loss);
}

/// J^T W J as a textbook writes it: one dense row after the other.
template <class Node>
Eigen::MatrixXd denseSystem(const BentHill& scene, const DeformOptions& options) {
  constexpr int n = Node::kUnknowns;
  const WarpGraph& graph = scene.graph;
  const Eigen::Index size = static_cast<Eigen::Index>(graph.size()) * n;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t s = 0; s < graph.stencils.size(); ++s) {
    const StencilRows& at = scene.constraints.stencils[s];
    for (int i = at.first; i < at.first + at.rows(); ++i) {
      const PlaneConstraint& c = scene.constraints.rows[i];
      const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3f>(c.point).cast<double>();
      const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3f>(c.normal).cast<double>();
      Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
      for (int k = 0; k < kNodesPerPoint; ++k) {
        const int node = graph.stencils[s][k];
        row.segment<n>(node * n) +=
            c.node_weights[k] *
            Node::leverJacobian(graph.transforms[node], p - graph.positions_mm[node]).transpose() *
            normal;
      }
      sum += scene.value.weights[i] * row * row.transpose();
    }
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    const double weight =
        options.regularisation_weight * scene.constraints.stiffness[e] * edge.weight;
    const ExpectedOffsets& expected = scene.constraints.expected[e];
    for (const auto& [own, other, expected_mm] :
         {std::tuple{edge.first, edge.second, expected.from_first_mm},
          std::tuple{edge.second, edge.first, expected.from_second_mm}}) {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, size);
      rows.middleCols<n>(own * n) = Node::leverJacobian(graph.transforms[own], expected_mm);
      rows.middleCols<3>(other * n + n - 3) = -Eigen::Matrix3d::Identity();
      sum += weight * rows.transpose() * rows;
    }
  }
  for (std::size_t j = 0; j < graph.size(); ++j)
    sum.diagonal().segment<3>(static_cast<Eigen::Index>(j + 1) * n - 3).array() +=
        options.rest_weight * scene.constraints.hidden[j];
  if (n == 12)
    for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(graph.size()); ++j) {
      const Eigen::Matrix<double, 6, 12> rows = rotationJacobian(graph.transforms[j].linear);
      sum.block<12, 12>(j * 12, j * 12) += options.rotation_weight * rows.transpose() * rows;
    }
  return sum;
}

template <class Node>
void expectBlocks(NodeModel model) {
  const DeformOptions options = testOptions(model, RobustLoss::kHuber);
  BentHill scene(options);
  const BlockPattern pattern = makeBlockPattern(scene.graph);
  NormalEquations<Node> equations;
  equations.analyse(scene.graph, pattern);
  equations.assemble(scene.graph, scene.constraints, scene.value, options);
  constexpr int n = Node::kUnknowns;
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(pattern.nodes() * n, pattern.nodes() * n);
  for (int j = 0; j < pattern.nodes(); ++j)
    for (int b = pattern.column_start[j]; b < pattern.column_start[j + 1]; ++b) {
      const Eigen::Map<const Eigen::Matrix<double, n, n>> block(equations.blocks().data() +
                                                                b * n * n);
      found.block<n, n>(pattern.row[b] * n, j * n) = block;
      found.block<n, n>(j * n, pattern.row[b] * n) = block.transpose();
    }
  const Eigen::MatrixXd truth = denseSystem<Node>(scene, options);
  EXPECT_LT((found - truth).norm(), 1e-12 * truth.norm());  // the same sums, another order
}

TEST(NormalEquations, BlocksAreThoseOfTheTextbookForRigidNodes) {
  expectBlocks<RigidNode>(NodeModel::kRigid);
}

TEST(NormalEquations, BlocksAreThoseOfTheTextbookForAffineNodes) {
  expectBlocks<AffineNode>(NodeModel::kAffine);
}

TEST(NormalEquations, AreTheSameBytesOnAnyNumberOfThreads) {
  const DeformOptions options = testOptions(NodeModel::kRigid, RobustLoss::kHuber);
  std::vector<std::vector<double>> blocks;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    BentHill scene(options);
    NormalEquations<RigidNode> equations;
    equations.analyse(scene.graph, makeBlockPattern(scene.graph));
    equations.assemble(scene.graph, scene.constraints, scene.value, options);
    blocks.push_back(equations.blocks());
    blocks.back().push_back(scene.value.terms.total());
  }
  EXPECT_EQ(blocks[0], blocks[1]);
  EXPECT_EQ(blocks[0], blocks[2]);
}

}  // namespace
}  // namespace softscope
