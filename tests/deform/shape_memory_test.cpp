// tests/deform/shape_memory_test.cpp: offsets that edges store, by hand.
#include "deform/graph/shape_memory.h"

#include <gtest/gtest.h>

#include "deform/graph/warp.h"
#include "deform/kernels/node_terms.h"
#include "deform/solver/lm_solver.h"

namespace softscope {
namespace {

/// Two nodes 4 mm apart, carried to where each frame of a test puts them.
WarpGraph twoNodes() {
  WarpGraph graph;
  graph.positions_mm = {{0, 0, 0}, {4, 0, 0}};
  graph.transforms.resize(2);
  graph.edges = {{0, 1, 1.0}};
  graph.stencils = {{0, 1, 1, 1}};
  return graph;
}

/// One frame: both nodes turn alike, the second one is taken to a place.
void moveTo(const Eigen::Matrix3d& turn, const Eigen::Vector3d& first_mm,
            const Eigen::Vector3d& second_mm, WarpGraph* graph) {
  graph->transforms[0] = {turn, first_mm - graph->positions_mm[0]};
  graph->transforms[1] = {turn, second_mm - graph->positions_mm[1]};
  rebase(graph);
}

ExpectedOffsets expectedBy(const WarpGraph& graph, double memory) {
  ConstraintSet constraints;
  expectShape(graph, memory, &constraints.expected);
  return constraints.expected.at(0);
}

TEST(ShapeMemory, OfANewEdgeIsThePresentShape) {
  const ExpectedOffsets expected = expectedBy(twoNodes(), 1);
  EXPECT_EQ(expected.from_first_mm, Eigen::Vector3d(4, 0, 0));
  EXPECT_EQ(expected.from_second_mm, Eigen::Vector3d(-4, 0, 0));
}

TEST(ShapeMemory, TurnsWithTheTissue) {
  WarpGraph graph = twoNodes();
  const Eigen::Matrix3d turn = rotationOf({0.2, -0.1, 0.3}).toRotationMatrix();
  Eigen::Vector3d end(4, 0, 0);
  for (int frame = 0; frame < 5; ++frame) {
    end = turn * end;
    moveTo(turn, {0, 0, 0}, end, &graph);
  }
  const ExpectedOffsets expected = expectedBy(graph, 1);
  EXPECT_LT((expected.from_first_mm - end).norm(), 1e-12);
  EXPECT_LT((expected.from_second_mm + end).norm(), 1e-12);
}

TEST(ShapeMemory, IsTheMeanOfTheFrames) {
  WarpGraph graph = twoNodes();
  const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
  moveTo(still, {0, 0, 0}, {4, 0, 0}, &graph);
  moveTo(still, {0, 0, 0}, {5, 0, 0}, &graph);
  EXPECT_DOUBLE_EQ(expectedBy(graph, 0).from_first_mm.x(), 5);
  EXPECT_DOUBLE_EQ(expectedBy(graph, 1).from_first_mm.x(), 4.5);
  EXPECT_DOUBLE_EQ(expectedBy(graph, 0.2).from_first_mm.x(), 4.9);
  EXPECT_DOUBLE_EQ(expectedBy(graph, 0.2).from_second_mm.x(), -4.9);
  // Tissue that stays so long as this has this shape.
  for (int frame = 0; frame < 1000; ++frame) moveTo(still, {0, 0, 0}, {5, 0, 0}, &graph);
  EXPECT_NEAR(expectedBy(graph, 1).from_first_mm.x(), 5, 1e-3);
}

TEST(ShapeMemory, StaysWithEdgesThatStay) {
  const std::vector<GraphEdge> before = {{0, 1, 1.0}, {0, 2, 1.0}, {1, 3, 1.0}};
  std::vector<EdgeShape> shapes(3);
  shapes[0].frames = 5;
  shapes[1].frames = 6;
  shapes[2].frames = 7;
  shapes[2].from_second_mm = {1, 2, 3};
  const std::vector<GraphEdge> after = {{0, 1, 0.5}, {1, 2, 1.0}, {1, 3, 1.0}, {2, 3, 1.0}};
  const std::vector<EdgeShape> kept = edgeShapesOf(after, before, shapes);
  ASSERT_EQ(kept.size(), 4u);
  EXPECT_EQ(kept[0].frames, 5);
  EXPECT_EQ(kept[1].frames, 0);
  EXPECT_EQ(kept[2].frames, 7);
  EXPECT_EQ(kept[2].from_second_mm, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(kept[3].frames, 0);
  // New edges have none yet.
  EXPECT_EQ(edgeShapesOf(after, before, {}).front().frames, 0);
}

/// Length of the edge after frames that hold the first node alone, once errors had stretched it.
double lengthAfterRestMm(double memory) {
  WarpGraph graph = twoNodes();
  for (int frame = 0; frame < 50; ++frame)
    moveTo(Eigen::Matrix3d::Identity(), {0, 0, 0}, {4, 0, 0}, &graph);
  moveTo(Eigen::Matrix3d::Identity(), {0, 0, 0}, {5, 0, 0}, &graph);
  PointModel model;
  model.add({0, 0, 0}, {0, 0, -1}, {}, 1);
  model.bindings[0] = {0, {1, 0, 0, 0}};
  DeformObservation seen;
  KeyPointMatch match;
  match.source_mm = match.target_mm = {0, 0, 0};
  seen.matches = {match};
  DeformOptions options;
  options.shape_memory = memory;
  options.rest_weight = 1e-6;
  const std::unique_ptr<DeformSolver> solver = makeDeformSolver(options);
  for (int frame = 0; frame < 10; ++frame) {
    solver->solve(model, seen, &graph);
    rebase(&graph);
  }
  return (graph.positions_mm[1] - graph.positions_mm[0]).norm();
}

TEST(ShapeMemory, TakesBackWhatNothingHolds) {
  for (const double memory : {0.0, 0.2, 1.0}) {
    double length_mm = 5, mean_mm = (50 * 4 + 5) / 51.0, frames = 51;
    for (int frame = 0; frame < 10; ++frame) {
      length_mm += memory * (mean_mm - length_mm);
      mean_mm += (length_mm - mean_mm) / ++frames;
    }
    EXPECT_NEAR(lengthAfterRestMm(memory), length_mm, 1e-4) << memory;
  }
}

}  // namespace
}  // namespace softscope
