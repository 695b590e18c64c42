// tests/pipeline/active_region_test.cpp: points far from the view rest, and come back in place.
#include "pipeline/model/active_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "deform/graph/graph_edges.h"
#include "deform/graph/warp.h"
#include "deform/scenes.h"
#include "deform/solver/local_solver.h"

namespace softscope {
namespace {

constexpr double kSpacingMm = 4;

Eigen::Isometry3d scopeAt(double x_mm) {
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  world_from_left.translation().x() = x_mm;
  return world_from_left;
}

/// A view of 30 x 30 mm at the hill's distance.
ActiveRegion regionAt(double x_mm, double spacing_mm = kSpacingMm) {
  return {scenes::makeCamera(200, 200, 400), scopeAt(x_mm), spacing_mm};
}

/// 160 x 30 mm.
ModelState longHill(double spacing_mm = kSpacingMm) {
  ModelState state;
  state.model = scenes::makeHill(160, 30, 0.8);
  for (std::size_t i = 0; i < state.model.size(); ++i)
    state.model.weights[i] = static_cast<float>(i + 1);  // a number for each
  state.graph = scenes::bindGraph(&state.model, spacing_mm);
  rebase(&state.graph);
  return state;
}

struct NamedPoint {
  float number;
  Eigen::Vector3f position_mm, normal;
  std::array<float, kNodesPerPoint> weights;
  NodeStencil nodes;
};

/// Ascending by their numbers, whatever their order is now.
std::vector<NamedPoint> allPoints(const ModelState& state) {
  std::vector<NamedPoint> points;
  for (std::size_t i = 0; i < state.model.size(); ++i) {
    const PointBinding& binding = state.model.bindings[i];
    points.push_back({state.model.weights[i], state.model.positions_mm[i], state.model.normals[i],
                      binding.weights,
                      state.graph.stencils.at(static_cast<std::size_t>(binding.stencil))});
  }
  std::sort(points.begin(), points.end(),
            [](const auto& one, const auto& other) { return one.number < other.number; });
  return points;
}

void expectSame(const ModelState& expected, const ModelState& found, float tolerance_mm) {
  const std::vector<NamedPoint> before = allPoints(expected), now = allPoints(found);
  ASSERT_EQ(now.size(), before.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    ASSERT_EQ(now[i].number, before[i].number);
    ASSERT_EQ(now[i].weights, before[i].weights);
    ASSERT_EQ(now[i].nodes, before[i].nodes);
    ASSERT_LT((now[i].position_mm - before[i].position_mm).norm(), tolerance_mm);
    ASSERT_LT((now[i].normal - before[i].normal).norm(), tolerance_mm);
  }
}

std::vector<Eigen::Vector3f> inactiveOf(const ModelState& state) {
  std::vector<Eigen::Vector3f> all;
  for (const InactivePoints& block : state.inactive)
    all.insert(all.end(), block.points.positions_mm.begin(), block.points.positions_mm.end());
  return all;
}

TEST(ActiveRegion, TakesOutWhatLiesBeyondAndBringsItBack) {
  const ModelState whole = longHill();
  ModelState state = whole;

  const IndexMap kept = regionAt(-60).deactivate(&state);

  EXPECT_EQ(state.model.size() + countInactive(state), whole.model.size());
  EXPECT_GT(countInactive(state), whole.model.size() / 2);
  // The image and a quarter of it on each side are 45 mm; around them, what shares their nodes.
  for (const Eigen::Vector3f& point_mm : state.model.positions_mm)
    EXPECT_LT(point_mm.x(), -60 + 22.5 + 4 * kSpacingMm);
  for (const Eigen::Vector3f& point_mm : inactiveOf(state)) EXPECT_GT(point_mm.x(), -60 + 22.5);
  ASSERT_EQ(kept.new_of_old.size(), whole.model.size());
  for (std::size_t i = 0; i < whole.model.size(); ++i)
    if (kept.new_of_old[i] >= 0) {
      EXPECT_EQ(state.model.weights[static_cast<std::size_t>(kept.new_of_old[i])],
                whole.model.weights[i]);
    }

  activateAll(&state);
  EXPECT_EQ(countInactive(state), 0u);
  expectSame(whole, state, 2e-5F);  // rounding at 80 mm
}

TEST(ActiveRegion, EntersWithAMargin) {
  ModelState state = longHill();
  regionAt(-60).deactivate(&state);
  const std::size_t inactive = countInactive(state);
  EXPECT_FALSE(regionAt(-60).reachesInactive(state));
  EXPECT_FALSE(regionAt(-58).reachesInactive(state));
  ASSERT_TRUE(regionAt(-50).reachesInactive(state));
  regionAt(-50).activate(&state);
  EXPECT_LT(countInactive(state), inactive);
  EXPECT_FALSE(regionAt(-50).reachesInactive(state));
  EXPECT_FALSE(regionAt(-48).reachesInactive(state));
  for (const Eigen::Vector3f& point_mm : inactiveOf(state)) EXPECT_GT(point_mm.x(), -50 + 22.5);
}

/// A little in each frame, as tissue that breathes: not the same in all places.
void moveALittle(int frame, WarpGraph* graph) {
  for (std::size_t j = 0; j < graph->size(); ++j) {
    const Eigen::Vector3d& node_mm = graph->positions_mm[j];
    const double angle_rad = 0.01 * std::sin(0.3 * frame) + 1e-4 * node_mm.x();
    graph->transforms[j].linear =
        Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    graph->transforms[j].translation_mm =
        graph->transforms[j].linear * node_mm - node_mm +
        Eigen::Vector3d(0.1, 0, 0.05 * std::sin(node_mm.y() / 20));
  }
}

TEST(ActiveRegion, CarriesInactivePointsByTheMotionOfTheirNodes) {
  ModelState whole = longHill();
  ModelState state = whole;
  for (int frame = 0; frame < 20; ++frame) {
    for (ModelState* each : {&whole, &state}) {
      moveALittle(frame, &each->graph);
      warpModel(each->graph, &each->model);
      rebase(&each->graph);
    }
    if (frame % 5 == 0) regionAt(-60 + 4 * frame).deactivate(&state);
  }
  EXPECT_GT(countInactive(state), 0u);
  activateAll(&state);
  // One warp by the whole motion, for 20 blended ones: they differ by what neighbouring nodes
  // turn against each other.
  expectSame(whole, state, 0.02F);
}

TEST(ActiveRegion, KeepsTheEdgesOfInactivePoints) {
  ModelState state = longHill();
  const std::vector<GraphEdge> before = makeEdges(state.graph, GraphOptions());
  regionAt(-60).deactivate(&state);
  const std::vector<GraphEdge> after = makeEdges(state.graph, GraphOptions());
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t e = 0; e < after.size(); ++e)
    ASSERT_EQ(std::tie(after[e].first, after[e].second),
              std::tie(before[e].first, before[e].second));
}

TEST(ActiveRegion, KeepsWhatIsAroundTrackedPoints) {
  ModelState state = longHill();
  const auto far = static_cast<std::size_t>(
      std::max_element(state.model.positions_mm.begin(), state.model.positions_mm.end(),
                       [](const auto& one, const auto& other) { return one.x() < other.x(); }) -
      state.model.positions_mm.begin());
  MaterialPoints::Point tracked;
  tracked.model_point = static_cast<std::int32_t>(far);
  state.tracked.points = {tracked, MaterialPoints::Point()};
  const Eigen::Vector3f at_mm = state.model.positions_mm[far];

  const IndexMap kept = regionAt(-60).deactivate(&state);

  ASSERT_GE(kept.new_of_old[far], 0);
  std::size_t around = 0;
  for (const Eigen::Vector3f& point_mm : state.model.positions_mm)
    around += (point_mm - at_mm).norm() < kSpacingMm / 2;
  std::size_t inactive_around = 0;
  for (const Eigen::Vector3f& point_mm : inactiveOf(state))
    inactive_around += (point_mm - at_mm).norm() < kSpacingMm / 2;
  EXPECT_GT(around, 5u);
  EXPECT_EQ(inactive_around, 0u);
}

TEST(ActiveRegion, LeavesNothingOfASmallGraphOrOfTissueInView) {
  EXPECT_FALSE(regionAt(-60).leavesMuch(longHill()));
  const ModelState large = longHill(2);
  ASSERT_GT(large.graph.size(), LocalRule::kWholeUpTo);
  EXPECT_TRUE(regionAt(-60, 2).leavesMuch(large));
  const ActiveRegion all(scenes::makeCamera(200, 200, 60), scopeAt(0), 2);
  EXPECT_FALSE(all.leavesMuch(large));
}

TEST(ActiveRegion, HoldsNothingBehindTheScope) {
  ModelState state = longHill();
  Eigen::Isometry3d turned = scopeAt(0);
  turned.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const ActiveRegion away(scenes::makeCamera(200, 200, 400), turned, kSpacingMm);
  away.deactivate(&state);
  EXPECT_EQ(state.model.size(), 0u);
  EXPECT_FALSE(away.reachesInactive(state));
  activateAll(&state);
  expectSame(longHill(), state, 2e-5F);
}

}  // namespace
}  // namespace softscope
