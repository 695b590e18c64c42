// tests/pipeline/graph_ahead_test.cpp: a graph that grows on a thread is the one that grows at
// once.
#include "pipeline/model/graph_ahead.h"

#include <gtest/gtest.h>

#include "deform/graph/graph_builder.h"
#include "deform/scenes.h"

namespace softscope {
namespace {

/// A hill of which the points beyond `limit_mm` are not bound yet.
struct Growing {
  explicit Growing(float limit_mm) {
    const PointModel whole = scenes::makeHill(40, 30, 0.4);
    const auto addBeyond = [&](bool beyond) {
      for (std::size_t i = 0; i < whole.size(); ++i)
        if ((whole.positions_mm[i].x() > limit_mm) == beyond)
          model.add(whole.positions_mm[i], whole.normals[i], whole.colours[i], 1);
    };
    addBeyond(false);
    graph = scenes::bindGraph(&model);
    addBeyond(true);
  }
  PointModel model;
  WarpGraph graph;
};

class GrowthAhead : public testing::TestWithParam<float> {};

TEST_P(GrowthAhead, IsTheSameAndKeepsTheMotionFoundMeanwhile) {
  Growing ahead(GetParam()), now(GetParam());
  const std::size_t nodes = ahead.graph.size();
  const auto solver = makeDeformSolver(DeformOptions());
  GraphAhead growth;
  growth.prepare(GraphOptions(), ahead.model, ahead.graph, solver.get());
  growth.waitForSolver();
  for (Growing* each : {&ahead, &now}) {
    scenes::moveNodes(scenes::rigidMotion(), &each->graph);
    each->graph.afar.assign(nodes, 0);
    each->graph.afar.front() = 1;
  }
  const std::vector<NodeTransform> found = now.graph.transforms;

  growth.grow(GraphOptions(), &ahead.model, &ahead.graph);
  GraphAhead().grow(GraphOptions(), &now.model, &now.graph);

  EXPECT_EQ(ahead.graph.stencils, now.graph.stencils);
  EXPECT_EQ(ahead.graph.afar, now.graph.afar);
  EXPECT_EQ(now.graph.afar.front(), 1);
  ASSERT_EQ(ahead.graph.transforms.size(), now.graph.size());
  ASSERT_GE(now.graph.size(), nodes);
  for (std::size_t j = 0; j < now.graph.size(); ++j) {
    EXPECT_EQ(ahead.graph.positions_mm[j], now.graph.positions_mm[j]);
    EXPECT_EQ(ahead.graph.transforms[j].translation_mm, now.graph.transforms[j].translation_mm);
    if (j < nodes) {
      EXPECT_EQ(now.graph.transforms[j].translation_mm, found[j].translation_mm);
    }
  }
  for (std::size_t i = 0; i < now.model.size(); ++i) {
    ASSERT_TRUE(ahead.model.bindings[i].bound());
    ASSERT_EQ(ahead.model.bindings[i].stencil, now.model.bindings[i].stencil);
    ASSERT_EQ(ahead.model.bindings[i].weights, now.model.bindings[i].weights);
  }
}

INSTANTIATE_TEST_SUITE_P(Limits, GrowthAhead, testing::Values(19.9F, 10.0F));

TEST(GrowthAheadOfFew, CanWaitAndOfManyCannot) {
  const auto solver = makeDeformSolver(DeformOptions());
  for (const bool is_few : {true, false}) {
    Growing growing(is_few ? 19.9F : 10.0F);
    GraphAhead growth;
    EXPECT_EQ(growth.canWait(growing.model), is_few);
    growth.prepare(GraphOptions(), growing.model, growing.graph, solver.get());
    EXPECT_EQ(growth.canWait(growing.model), is_few);
    growth.drop();
    EXPECT_EQ(growth.canWait(growing.model), is_few);
  }
}

/// Keeps the nodes of the graph that it is prepared for.
class RememberingSolver : public DeformSolver {
 public:
  NodeModel nodeModel() const override { return NodeModel::kRigid; }
  void prepare(const WarpGraph& graph) override { prepared_mm = graph.positions_mm; }
  DeformSummary solve(const PointModel&, const DeformObservation&, WarpGraph*) override {
    return {};
  }
  std::vector<Eigen::Vector3d> prepared_mm;
};

TEST(GrowthAheadOfMany, PreparesTheSolverForTheGrownGraphThoughItIsTakenAtOnce) {
  const Growing begun(10.0F);
  for (int trial = 0; trial < 50; ++trial) {
    Growing growing = begun;
    RememberingSolver solver;
    GraphAhead growth;
    growth.prepare(GraphOptions(), growing.model, growing.graph, &solver);
    growth.grow(GraphOptions(), &growing.model, &growing.graph);
    growth.waitForSolver();
    ASSERT_EQ(solver.prepared_mm, growing.graph.positions_mm) << "trial " << trial;
  }
}

}  // namespace
}  // namespace softscope
