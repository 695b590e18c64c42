// tests/deform/stiffness_test.cpp: tissue is as stiff as its deformation, compared with the noise
// of the matches, allows.
#include "deform/energy/stiffness.h"

#include <gtest/gtest.h>

#include <random>

#include "deform/graph/warp.h"
#include "deform/solver/lm_solver.h"
#include "scenes.h"

namespace softscope {
namespace {

FirstFit fitOf(float match_mm, double edge_square_mm2, std::size_t count = 99) {
  return {std::vector<float>(count, match_mm), std::vector<double>(count, edge_square_mm2)};
}

TEST(Stiffness, StillTissueIsAsStiffAsTheOptionsSay) {
  EXPECT_EQ(stiffnessAfter(fitOf(0.5f, 0.25 * 0.25)), 1);
  EXPECT_EQ(stiffnessAfter(fitOf(0.5f, 0)), 1);
  EXPECT_EQ(stiffnessAfter(fitOf(0, 0)), 1);
}

// docs/energy.md (7c): edges of three times the square that noise leaves.
TEST(Stiffness, IsLessWhereEdgesDeformByMoreThanNoise) {
  EXPECT_DOUBLE_EQ(stiffnessAfter(fitOf(0.5f, 3 * 0.25 * 0.25)), 1.0 / 9);
}

TEST(Stiffness, DependsOnTheRatioAlone) {
  EXPECT_DOUBLE_EQ(stiffnessAfter(fitOf(0.5f, 0.1)), stiffnessAfter(fitOf(1.0f, 0.4)));
}

TEST(Stiffness, TheMedianMatchCounts) {
  FirstFit fit = fitOf(0.5f, 3 * 0.25 * 0.25, 100);
  for (std::size_t i = 0; i < 45; ++i) fit.matches_mm[i] = 50;  // wrong
  EXPECT_DOUBLE_EQ(stiffnessAfter(fit), 1.0 / 9);
}

TEST(Stiffness, FewMatchesOrEdgesSayNothing) {
  EXPECT_EQ(stiffnessAfter({}), 1);
  FirstFit few_matches = fitOf(0.5f, 1), few_edges = fitOf(0.5f, 1);
  few_matches.matches_mm.resize(19);
  few_edges.edges_square_mm2.resize(19);
  EXPECT_EQ(stiffnessAfter(few_matches), 1);
  EXPECT_EQ(stiffnessAfter(few_edges), 1);
}

TEST(Stiffness, IsBounded) {
  EXPECT_EQ(stiffnessAfter(fitOf(0.01f, 1)), 1.0 / 64);
  EXPECT_EQ(stiffnessAfter(fitOf(0, 1)), 1.0 / 64);
}

TEST(Stiffness, ScalesWhatHoldsTheTissue) {
  const DeformOptions usual, scaled = stiffer(usual, 4);
  EXPECT_EQ(scaled.regularisation_weight, 4 * usual.regularisation_weight);
  EXPECT_EQ(scaled.rest_weight, 4 * usual.rest_weight);
  EXPECT_EQ(scaled.data_weight, usual.data_weight);
  EXPECT_EQ(scaled.correspondence_weight, usual.correspondence_weight);
}

TEST(Stiffness, HiddenEdgesDoNotCount) {
  PointModel model = scenes::makeHill(20, 16, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  std::vector<NodeTransform> moved = graph.transforms;
  ConstraintSet constraints;
  constraints.hidden.assign(graph.size(), 0);
  for (const GraphEdge& edge : graph.edges) {
    const Eigen::Vector3d offset_mm = graph.positions_mm[static_cast<std::size_t>(edge.second)] -
                                      graph.positions_mm[static_cast<std::size_t>(edge.first)];
    constraints.expected.push_back({offset_mm, -offset_mm});
  }
  const std::size_t node = static_cast<std::size_t>(graph.edges.front().first);
  moved[node].translation_mm.x() += 0.5;
  const auto sumOf = [](const std::vector<double>& squares_mm2) {
    double sum = 0;
    for (const double square : squares_mm2) sum += square;
    return sum;
  };
  double expected_mm2 = 0;
  for (const GraphEdge& edge : graph.edges)
    if (static_cast<std::size_t>(edge.first) == node ||
        static_cast<std::size_t>(edge.second) == node)
      expected_mm2 += edge.weight * 0.25;
  const std::vector<double> seen =
      squaresOfSeenEdges(graph, edgeEnergies(graph, moved, constraints.expected), constraints);
  EXPECT_EQ(seen.size(), graph.edges.size());
  EXPECT_NEAR(sumOf(seen), expected_mm2, 1e-9);
  constraints.hidden[node] = 0.6;
  EXPECT_EQ(sumOf(squaresOfSeenEdges(graph, edgeEnergies(graph, moved, constraints.expected),
                                     constraints)),
            0);
}

/// Mean error after one frame whose matches are wrong by `sigma_mm` per axis.
double errorAfter(const scenes::Motion& truth, double sigma_mm, bool follows_tissue) {
  PointModel model = scenes::makeHill(40, 30, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, truth, 8);
  std::mt19937 random(5);
  std::normal_distribution<float> noise;
  const auto sigma = static_cast<float>(sigma_mm);
  for (KeyPointMatch& match : seen.matches)
    match.target_mm += sigma * Eigen::Vector3f(noise(random), noise(random), noise(random));
  DeformOptions options;
  options.solver.follows_tissue = follows_tissue;
  const auto view = scenes::renderHill(scenes::makeCamera(160, 130, 225), truth, 44, 34);
  const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                           options.association);
  seen.surface = &target;
  makeDeformSolver(options)->solve(model, seen, &graph);
  PointModel warped = model;
  warpModel(graph, &warped);
  return scenes::meanError(model, warped, truth);
}

TEST(Stiffness, ExactMatchesBendTheTissue) {
  EXPECT_LT(errorAfter(scenes::smoothBend, 0, true),
            0.6 * errorAfter(scenes::smoothBend, 0, false));
}

TEST(Stiffness, NoisyMatchesOfRigidTissueDoNot) {
  const scenes::Motion rigid = scenes::shift({1, 0.5, -0.5});
  EXPECT_LT(errorAfter(rigid, 0.3, true), 1.1 * errorAfter(rigid, 0.3, false));
}

}  // namespace
}  // namespace softscope
