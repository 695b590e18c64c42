// tests/deform/test_solver_limits.cpp: no crash and no NaN for any input.
#include <gtest/gtest.h>

#include <limits>

#include "deform/graph/warp.h"
#include "deform/solver/lm_solver.h"
#include "scenes.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool finite(const WarpGraph& graph) {
  for (const NodeTransform& transform : graph.transforms)
    if (!transform.linear.allFinite() || !transform.translation_mm.allFinite()) return false;
  return true;
}

bool unmoved(const WarpGraph& graph) {
  for (const NodeTransform& transform : graph.transforms)
    if (!transform.linear.isIdentity(1e-9) || !transform.translation_mm.isZero(1e-9)) return false;
  return true;
}

class SolverLimits : public ::testing::TestWithParam<NodeModel> {
 protected:
  DeformSummary solve(const PointModel& model, const DeformObservation& seen, WarpGraph* graph) {
    DeformOptions options =
        GetParam() == NodeModel::kAffine ? DeformOptions::paper() : DeformOptions();
    options.rest_weight = 0;  // the exact answers below are those of tissue that nothing holds
    return makeDeformSolver(options)->solve(model, seen, graph);
  }
};

TEST_P(SolverLimits, NoNodes) {
  WarpGraph graph;
  const DeformSummary summary = solve(PointModel(), {}, &graph);
  EXPECT_EQ(summary.reason, StopReason::kNothingToFit);
}

TEST_P(SolverLimits, NoData) {
  PointModel model = scenes::makeHill(20, 20, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  const DeformSummary summary = solve(model, {}, &graph);
  EXPECT_EQ(summary.reason, StopReason::kNothingToFit);
  EXPECT_EQ(summary.nodes_without_data, static_cast<int>(graph.size()));
  EXPECT_TRUE(unmoved(graph));
}

TEST_P(SolverLimits, ADepthMapOfNaN) {
  PointModel model = scenes::makeHill(20, 20, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  const PinholeCamera camera = scenes::makeCamera(64, 48, 100);
  const DepthMap depth{Raster<float>(64, 48, kNaN), Raster<float>(64, 48, kNaN)};
  const NormalMap normals(64, 48, Eigen::Vector3f::Constant(kNaN));
  const DepthTarget target(depth, normals, camera, Eigen::Isometry3d::Identity(), {});
  DeformObservation seen;
  seen.surface = &target;
  EXPECT_EQ(solve(model, seen, &graph).reason, StopReason::kNothingToFit);
  EXPECT_TRUE(unmoved(graph));
}

TEST_P(SolverLimits, OneNodeAndOneMatch) {
  PointModel model;
  model.add({0, 0, 50}, {0, 0, -1}, {}, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  DeformObservation seen;
  seen.matches.push_back({0, {0, 0, 50}, {1, 0, 50}});
  const DeformSummary summary = solve(model, seen, &graph);
  EXPECT_TRUE(finite(graph));
  EXPECT_NEAR(graph.transforms[0].translation_mm.x(), 1, 1e-3);
  EXPECT_LT(summary.after.total(), 1e-5);
}

TEST_P(SolverLimits, EverythingInPlaceAlready) {
  PointModel model = scenes::makeHill(20, 20, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, scenes::shift({0, 0, 0}), 10);
  const DeformSummary summary = solve(model, seen, &graph);
  EXPECT_TRUE(summary.converged()) << toString(summary.reason);
  EXPECT_TRUE(unmoved(graph));
}

TEST_P(SolverLimits, BrokenMatchesAndPointsAreLeftOut) {
  PointModel model = scenes::makeHill(20, 20, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  model.positions_mm[5].setConstant(kNaN);
  model.bindings[6].stencil = PointBinding::kUnbound;
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, scenes::shift({0.1, 0, 0}), 1);
  const int good = static_cast<int>(seen.matches.size()) - 2;
  seen.matches.push_back({-1, {0, 0, 50}, {0, 0, 50}});
  seen.matches.push_back({1 << 30, {0, 0, 50}, {0, 0, 50}});
  seen.matches.push_back({0, {0, 0, 50}, {kNaN, 0, 50}});
  const DeformSummary summary = solve(model, seen, &graph);
  EXPECT_EQ(summary.matches, good);
  EXPECT_EQ(summary.matches_dropped, 5);
  EXPECT_TRUE(finite(graph));
  EXPECT_LT(summary.after.total(), 1e-3 * summary.before.total());
}

TEST_P(SolverLimits, APartThatNothingPullsStays) {
  PointModel model = scenes::makeHill(12, 12, 0.5);
  const std::size_t near = model.size();
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j)
      model.add({200 + 0.4f * static_cast<float>(i), 0.4f * static_cast<float>(j), 60}, {0, 0, -1},
                {}, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  graph.edges.erase(
      std::remove_if(
          graph.edges.begin(), graph.edges.end(),
          [&](const GraphEdge& edge) {
            return (graph.positions_mm[edge.first] - graph.positions_mm[edge.second]).norm() > 50;
          }),
      graph.edges.end());
  DeformObservation seen;
  for (const KeyPointMatch& match : scenes::makeMatches(model, scenes::shift({0.5, 0, 0}), 5))
    if (match.model_point < static_cast<int>(near)) seen.matches.push_back(match);
  const DeformSummary summary = solve(model, seen, &graph);
  EXPECT_EQ(summary.components_without_data, 1);
  EXPECT_EQ(summary.warnings.size(), 2u);  // that it stays, and that damping alone holds it
  EXPECT_LT(summary.pivot_ratio, 3e-4);
  PointModel warped = model;
  warpModel(graph, &warped);
  EXPECT_NEAR(warped.positions_mm[near / 2].x() - model.positions_mm[near / 2].x(), 0.5, 1e-2);
  EXPECT_LT((warped.positions_mm.back() - model.positions_mm.back()).norm(), 1e-4f);
}

TEST_P(SolverLimits, AGraphWithNaNIsReportedAndLeftAlone) {
  PointModel model = scenes::makeHill(20, 20, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  graph.positions_mm[2].x() = kNaN;
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, scenes::smoothBend, 10);
  const DeformSummary summary = solve(model, seen, &graph);
  EXPECT_EQ(summary.reason, StopReason::kNotFinite);
  EXPECT_TRUE(unmoved(graph));
}

TEST_P(SolverLimits, TargetsAtTheEndOfTheWorld) {
  PointModel model = scenes::makeHill(20, 20, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  DeformObservation seen;
  seen.matches = scenes::makeMatches(
      model, [](const Eigen::Vector3d& p) -> Eigen::Vector3d { return 1e18 * p; }, 10);
  solve(model, seen, &graph);
  EXPECT_TRUE(finite(graph));
}

TEST_P(SolverLimits, AllWeightsZero) {
  PointModel model = scenes::makeHill(20, 20, 1);
  WarpGraph graph = scenes::bindGraph(&model);
  DeformOptions options;
  options.node_model = GetParam();
  options.rotation_weight = options.regularisation_weight = 0;
  options.data_weight = options.correspondence_weight = 0;
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, scenes::smoothBend, 10);
  makeDeformSolver(options)->solve(model, seen, &graph);
  EXPECT_TRUE(unmoved(graph));
}

INSTANTIATE_TEST_SUITE_P(RigidAndAffine, SolverLimits,
                         ::testing::Values(NodeModel::kRigid, NodeModel::kAffine));

}  // namespace
}  // namespace softscope
