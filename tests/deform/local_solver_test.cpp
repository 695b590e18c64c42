// tests/deform/local_solver_test.cpp: a large graph is solved around what is seen, a small one as a
// whole.
#include "deform/solver/local_solver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "deform/graph/warp.h"
#include "deform/solver/local_graph.h"
#include "scenes.h"

namespace softscope {
namespace {

constexpr double kSpacingMm = 4;

/// A long strip of tissue, of which a part is seen.
struct Strip {
  PointModel model;
  WarpGraph graph;
  std::vector<int> visible;
  DeformObservation seen;

  explicit Strip(double length_mm, double width_mm = 50) {
    model = scenes::makeHill(length_mm, width_mm, 1);
    graph = scenes::bindGraph(&model, kSpacingMm);
  }

  /// What lies between these first coordinates, moved by `motion`.
  void see(double from_mm, double to_mm, const scenes::Motion& motion) {
    visible.clear();
    for (std::size_t i = 0; i < model.size(); ++i)
      if (model.positions_mm[i].x() >= from_mm && model.positions_mm[i].x() <= to_mm)
        visible.push_back(static_cast<int>(i));
    seen.visible = &visible;
    seen.matches.clear();
    for (const KeyPointMatch& match : scenes::makeMatches(model, motion, 7))
      if (match.source_mm.x() >= from_mm && match.source_mm.x() <= to_mm)
        seen.matches.push_back(match);
  }
};

std::unique_ptr<DeformSolver> localSolver() {
  return makeLocalSolver(makeDeformSolver(DeformOptions()), kSpacingMm);
}

bool sameTransforms(const WarpGraph& a, const WarpGraph& b) {
  return std::equal(a.transforms.begin(), a.transforms.end(), b.transforms.begin(),
                    b.transforms.end(), [](const NodeTransform& x, const NodeTransform& y) {
                      return x.linear == y.linear && x.translation_mm == y.translation_mm;
                    });
}

/// Mean over the visible points, mm.
double errorOfSeen(const Strip& strip, const WarpGraph& graph, const scenes::Motion& truth) {
  double sum_mm = 0;
  for (const int i : strip.visible) {
    const Eigen::Vector3d from_mm = strip.model.positions_mm[i].cast<double>();
    sum_mm += (warpPoint(graph, strip.model.bindings[i], from_mm) - truth(from_mm)).norm();
  }
  return sum_mm / static_cast<double>(strip.visible.size());
}

const scenes::Motion kBend = scenes::smoothBend;

TEST(LocalSolver, SolvesSmallGraphsAsAWhole) {
  Strip strip(100);
  ASSERT_LE(strip.graph.size(), LocalRule::kWholeUpTo);
  strip.see(-50, -30, kBend);
  WarpGraph whole = strip.graph;
  makeDeformSolver(DeformOptions())->solve(strip.model, strip.seen, &whole);
  localSolver()->solve(strip.model, strip.seen, &strip.graph);
  EXPECT_TRUE(sameTransforms(strip.graph, whole));
  EXPECT_TRUE(strip.graph.afar.empty());
}

TEST(LocalSolver, MovesWhatIsSeenLikeTheWholeGraphDoes) {
  Strip strip(260);
  ASSERT_GT(strip.graph.size(), LocalRule::kWholeUpTo);
  strip.see(-120, -80, kBend);
  DeformOptions options;
  options.solver.follows_tissue = false;
  options.regularisation_weight = 30;  // both of the same stiffness
  options.rest_weight = 0.01;
  options.solver.max_iterations = 30;
  options.solver.step_tolerance_mm = 1e-6;
  options.solver.cost_tolerance = 1e-9;
  WarpGraph whole = strip.graph;
  makeDeformSolver(options)->solve(strip.model, strip.seen, &whole);
  const DeformSummary summary = makeLocalSolver(makeDeformSolver(options), kSpacingMm)
                                    ->solve(strip.model, strip.seen, &strip.graph);
  EXPECT_TRUE(summary.converged()) << toString(summary.reason);
  ASSERT_EQ(strip.graph.afar.size(), strip.graph.size());
  for (std::size_t j = 0; j < strip.graph.size(); ++j) {
    const double x_mm = strip.graph.positions_mm[j].x();
    const double beyond_mm = std::max(x_mm + 80, 0.0);  // of the points, not of their nodes
    if (beyond_mm < 0.9 * LocalRule::kChosen * kSpacingMm)
      EXPECT_EQ(strip.graph.afar[j], 0) << x_mm;
    if (beyond_mm > (LocalRule::kChosen + 2) * kSpacingMm)
      EXPECT_EQ(strip.graph.afar[j], 1) << x_mm;
    if (x_mm > -90) continue;
    EXPECT_LT(
        (strip.graph.transforms[j].translation_mm - whole.transforms[j].translation_mm).norm(),
        0.005)
        << x_mm;
  }
  // The rest of far tissue holds the border of what is seen no more.
  EXPECT_LE(errorOfSeen(strip, strip.graph, kBend), errorOfSeen(strip, whole, kBend));
}

TEST(LocalSolver, WhatIsFarFollowsWithoutTurning) {
  Strip strip(260);
  const Eigen::Vector3d by_mm(0.8, -0.5, 0.6);
  strip.see(-120, -80, scenes::shift(by_mm));
  DeformOptions options;
  options.rest_weight = 0;  // tissue that nothing holds
  makeLocalSolver(makeDeformSolver(options), kSpacingMm)
      ->solve(strip.model, strip.seen, &strip.graph);
  int far = 0;
  for (std::size_t j = 0; j < strip.graph.size(); ++j) {
    const NodeTransform& transform = strip.graph.transforms[j];
    EXPECT_LT((transform.translation_mm - by_mm).norm(), 1e-3) << strip.graph.positions_mm[j].x();
    if (strip.graph.afar[j] == 0) continue;
    ++far;
    EXPECT_EQ(transform.linear, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  }
  EXPECT_GT(far, 200);
}

TEST(LocalSolver, KeepsItsChoiceUntilTheViewHasMovedOn) {
  Strip strip(260);
  const auto solver = localSolver();
  const auto chosen = [&](double from_mm) {
    WarpGraph graph = strip.graph;
    strip.see(from_mm, from_mm + 40, scenes::shift({0.1, 0, 0}));
    solver->solve(strip.model, strip.seen, &graph);
    strip.graph.afar = graph.afar;
    return graph.afar;
  };
  const std::vector<std::uint8_t> first = chosen(-60);
  EXPECT_EQ(chosen(-56), first);
  EXPECT_EQ(chosen(-64), first);
  const std::vector<std::uint8_t> moved = chosen(-30);
  EXPECT_NE(moved, first);
  EXPECT_EQ(chosen(-27), moved);
}

TEST(LocalSolver, GivesTheSameBytesPreparedOrNotAndAfterAResume) {
  Strip strip(260);
  strip.see(-120, -80, kBend);
  const auto solver = localSolver();
  WarpGraph first = strip.graph;
  solver->solve(strip.model, strip.seen, &first);
  rebase(&first);
  for (Eigen::Vector3f& point_mm : strip.model.positions_mm)
    if (point_mm.x() < -70) point_mm += Eigen::Vector3f(0.1F, 0, 0);
  WarpGraph again = first, prepared = first, resumed = first;
  solver->solve(strip.model, strip.seen, &again);
  solver->prepare(prepared);
  solver->solve(strip.model, strip.seen, &prepared);
  localSolver()->solve(strip.model, strip.seen, &resumed);
  EXPECT_TRUE(sameTransforms(again, prepared));
  EXPECT_TRUE(sameTransforms(again, resumed));
}

TEST(LocalSolver, WithoutAnythingInSightAllStaysAsItWasChosen) {
  Strip strip(260);
  strip.see(-120, -80, kBend);
  const auto solver = localSolver();
  solver->solve(strip.model, strip.seen, &strip.graph);
  rebase(&strip.graph);
  const std::vector<std::uint8_t> before = strip.graph.afar;
  strip.see(1000, 1001, kBend);
  const DeformSummary summary = solver->solve(strip.model, strip.seen, &strip.graph);
  EXPECT_EQ(summary.reason, StopReason::kNothingToFit);
  EXPECT_EQ(strip.graph.afar, before);
  for (const NodeTransform& transform : strip.graph.transforms)
    EXPECT_EQ(transform.translation_mm.norm(), 0);
}

/// Nodes 0 - 1 - 2 - 3 and 4 alone, 1 mm apart; stencils of two nodes.
WarpGraph chain() {
  WarpGraph graph;
  for (int j = 0; j < 5; ++j) graph.positions_mm.emplace_back(j, 0, 50);
  graph.transforms.resize(5);
  graph.edges = {{0, 1}, {1, 2}, {2, 3}};
  graph.stencils = {{0, 1, 1, 1}, {1, 2, 2, 2}, {2, 3, 3, 3}};
  return graph;
}

TEST(LocalGraph, MeasuresDistancesAlongEdges) {
  const WarpGraph graph = chain();
  const std::vector<double> away_mm =
      distancesFrom({0, 1, 0, 0, 0}, graph, neighboursOf(graph), 1.5);
  EXPECT_EQ(away_mm[0], 1);
  EXPECT_EQ(away_mm[1], 0);
  EXPECT_EQ(away_mm[2], 1);
  EXPECT_TRUE(std::isinf(away_mm[3]));  // 2 mm
  EXPECT_TRUE(std::isinf(away_mm[4]));  // no path
}

TEST(LocalGraph, KeepsTheNeighboursOfTheGraphThatWasTakenAlone) {
  WarpGraph graph = chain(), another = chain();
  graph.afar = {0, 0, 1, 1, 1};
  another.edges.pop_back();
  LocalGraph local;
  local.take(graph);
  for (const WarpGraph* each : {&graph, &another, &graph}) {
    const NodeNeighbours expected = neighboursOf(*each), found = local.neighboursIn(*each);
    EXPECT_EQ(found.start, expected.start);
    EXPECT_EQ(found.nodes, expected.nodes);
  }
}

TEST(LocalGraph, HasTheNodesNearbyAndAllStencils) {
  WarpGraph whole = chain();
  whole.afar = {1, 0, 0, 1, 1};
  LocalGraph local;
  local.take(whole);
  EXPECT_EQ(local.graph().size(), 2U);
  EXPECT_EQ(local.graph().positions_mm[0], whole.positions_mm[1]);
  ASSERT_EQ(local.graph().edges.size(), 1U);
  EXPECT_EQ(local.graph().edges[0].second, 1);
  EXPECT_EQ(local.graph().stencils,
            (std::vector<NodeStencil>{kOutsideStencil, {0, 1, 1, 1}, kOutsideStencil}));
  local.graph().transforms[0].translation_mm = {1, 0, 0};
  local.graph().transforms[1].translation_mm = {3, 0, 0};
  local.returnTo(&whole);
  const double moved_mm[] = {1, 1, 3, 3, 0};
  for (int j = 0; j < 5; ++j) EXPECT_EQ(whole.transforms[j].translation_mm.x(), moved_mm[j]) << j;
}

}  // namespace
}  // namespace softscope
