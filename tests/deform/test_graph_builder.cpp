// tests/deform/test_graph_builder.cpp: nodes cover the tissue and keep to their own side of a gap.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/error.h"
#include "core/parallel.h"
#include "deform/graph/graph_edges.h"
#include "deform/graph/warp.h"
#include "scenes.h"

namespace softscope {
namespace {

double distanceToNearest(const WarpGraph& graph, const Eigen::Vector3f& point_mm) {
  double nearest = std::numeric_limits<double>::max();
  for (const Eigen::Vector3d& g : graph.positions_mm)
    nearest = std::min(nearest, (g - point_mm.cast<double>()).norm());
  return nearest;
}

TEST(GraphBuilder, CoversTheModelAtTheSpacing) {
  PointModel model = scenes::makeHill(40, 30, 0.4);
  const WarpGraph graph = scenes::bindGraph(&model);
  for (const Eigen::Vector3f& p : model.positions_mm)
    EXPECT_LT(distanceToNearest(graph, p), 4.0 + 1.0);  // spacing and half a cell's diagonal
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((graph.positions_mm[i] - graph.positions_mm[j]).norm(), 4.0 - 1.0);
  // One node takes between a hexagon of this spacing (13.9 mm²) and three of them.
  EXPECT_GT(graph.size(), 40 * 30 / (3 * 13.9));
  EXPECT_LT(graph.size(), 1.4 * 40 * 30 / 13.9);  // borders take half hexagons
}

/// Nodes by their distance from a point, nearest first.
std::vector<std::pair<double, int>> nodesByDistance(const WarpGraph& graph,
                                                    const Eigen::Vector3f& point_mm) {
  std::vector<std::pair<double, int>> sorted;
  for (std::size_t j = 0; j < graph.size(); ++j)
    sorted.emplace_back((graph.positions_mm[j] - point_mm.cast<double>()).norm(), j);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// Share of the first points that are bound to the four nearest nodes.
double boundToTheNearest(const PointModel& model, std::size_t points, const WarpGraph& graph) {
  int right = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const auto sorted = nodesByDistance(graph, model.positions_mm[i]);
    NodeStencil nearest;
    for (std::size_t k = 0; k < nearest.size(); ++k) nearest[k] = sorted[k].second;
    std::sort(nearest.begin(), nearest.end());
    right += graph.stencils[model.bindings[i].stencil] == nearest;
  }
  return right / static_cast<double>(points);
}

TEST(GraphBuilder, BindsToTheFourNearestWithThePapersWeights) {
  PointModel model = scenes::makeHill(40, 30, 0.4);
  const WarpGraph graph = scenes::bindGraph(&model);
  for (std::size_t i = 0; i < model.size(); i += 17) {
    const PointBinding& binding = model.bindings[i];
    ASSERT_TRUE(binding.bound());
    const auto sorted = nodesByDistance(graph, model.positions_mm[i]);
    double total = 0;
    for (int k = 0; k < 4; ++k) total += 1 - sorted[k].first / sorted[4].first;
    for (int k = 0; k < 4; ++k) {
      const NodeStencil& stencil = graph.stencils[binding.stencil];
      const auto at = std::find(stencil.begin(), stencil.end(), sorted[k].second);
      ASSERT_NE(at, stencil.end());
      EXPECT_NEAR(binding.weights[at - stencil.begin()],
                  (1 - sorted[k].first / sorted[4].first) / total, 1e-5);  // stored as float
    }
  }
}

/// A step of 6 mm in depth: an organ in front of another.
PointModel makeStep() {
  PointModel model;
  for (double y = -8; y <= 8; y += 0.4)
    for (double x = -16; x <= 16; x += 0.4)
      model.add(Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), x < 0 ? 50.f : 56.f),
                {0, 0, -1}, {}, 1);
  return model;
}

TEST(GraphBuilder, NodesDoNotCarryPointsAcrossAGapInDepth) {
  PointModel model = makeStep();
  const WarpGraph graph = scenes::bindGraph(&model);
  for (std::size_t i = 0; i < model.size(); ++i) {
    const PointBinding& binding = model.bindings[i];
    ASSERT_TRUE(binding.bound());
    for (int k = 0; k < 4; ++k) {
      if (binding.weights[k] == 0) continue;
      const Eigen::Vector3d& g = graph.positions_mm[graph.stencils[binding.stencil][k]];
      EXPECT_NEAR(g.z(), model.positions_mm[i].z(), 0.1);
    }
  }
}

TEST(GraphBuilder, EdgesTieTheTwoSidesOfAGap) {
  PointModel model = makeStep();
  const WarpGraph graph = scenes::bindGraph(&model);
  const auto across = std::count_if(graph.edges.begin(), graph.edges.end(), [&](const auto& edge) {
    return std::abs(graph.positions_mm[edge.first].z() - graph.positions_mm[edge.second].z()) > 3;
  });
  EXPECT_EQ(across, 3);  // three bridges hold position and rotation
}

/// Adds the points of one half of a model, right or left of x = 0, moved.
void addHalf(const PointModel& whole, bool is_right, const Eigen::Isometry3d& motion,
             PointModel* model) {
  for (std::size_t i = 0; i < whole.size(); ++i)
    if ((whole.positions_mm[i].x() >= 0) == is_right)
      model->add((motion * whole.positions_mm[i].cast<double>()).cast<float>(), whole.normals[i],
                 whole.colours[i], 1);
}

/// The graph of the left half of a model, which is added.
WarpGraph bindLeftHalf(const PointModel& whole, PointModel* model) {
  addHalf(whole, false, Eigen::Isometry3d::Identity(), model);
  return scenes::bindGraph(model);
}

/// Islands of six nodes, of which each is one part: stencils connect neighbours.
WarpGraph islands(int count) {
  WarpGraph graph;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at_mm(-80, 80), near_mm(-5, 5);
  for (int island = 0; island < count; ++island) {
    const Eigen::Vector3d centre_mm(at_mm(random), at_mm(random), at_mm(random) / 8);
    for (std::int32_t k = 0; k < 6; ++k) {
      graph.positions_mm.push_back(
          centre_mm + Eigen::Vector3d(near_mm(random), near_mm(random), near_mm(random)));
      const std::int32_t node = 6 * island + k;
      if (k > 0) graph.stencils.push_back({node - 1, node, node, node});
    }
  }
  return graph;
}

TEST(GraphBuilder, TiesIslandsWhereTheyAreNearest) {
  const WarpGraph graph = islands(30);
  const std::vector<GraphEdge> edges = makeEdges(graph, GraphOptions());
  const auto tied = [&](int a, int b) {
    return std::any_of(edges.begin(), edges.end(), [&](const GraphEdge& edge) {
      return edge.first == std::min(a, b) && edge.second == std::max(a, b);
    });
  };
  int missing = 0;  // those of the largest island: of equal ones the first
  for (int island = 0; island < 30; ++island) {
    struct Tie {
      double away_mm;
      int to, from;
      bool operator<(const Tie& other) const { return away_mm < other.away_mm; }
    };
    std::vector<Tie> ties;
    for (int i = 6 * island; i < 6 * island + 6; ++i)
      for (int j = 0; j < static_cast<int>(graph.size()); ++j)
        if (j / 6 != island)
          ties.push_back({(graph.positions_mm[i] - graph.positions_mm[j]).norm(), j, i});
    std::sort(ties.begin(), ties.end());
    const int from = ties.front().from;
    ties.erase(
        std::remove_if(ties.begin(), ties.end(), [&](const Tie& tie) { return tie.from != from; }),
        ties.end());
    for (int k = 0; k < 3; ++k)
      if (!tied(from, ties[static_cast<std::size_t>(k)].to)) ++missing;
  }
  EXPECT_LE(missing, 3);
}

TEST(GraphBuilder, GrowsWithoutRenumberingNodes) {
  const PointModel whole = scenes::makeHill(40, 20, 0.4);
  PointModel model;
  WarpGraph graph = bindLeftHalf(whole, &model);
  const std::size_t old_points = model.size();
  const WarpGraph before = graph;
  addHalf(whole, true, Eigen::Isometry3d::Identity(), &model);

  const GraphGrowth growth = growGraph(GraphOptions(), &model, &graph);

  EXPECT_TRUE(growth.structure_changed);
  EXPECT_EQ(growth.nodes_added, static_cast<int>(graph.size() - before.size()));
  EXPECT_GT(growth.nodes_added, 10);
  EXPECT_EQ(growth.points_bound, static_cast<int>(model.size() - old_points));
  EXPECT_GT(growth.points_rebound, 0);  // old points near the seam have nearer nodes now
  for (std::size_t j = 0; j < before.size(); ++j)
    EXPECT_EQ(graph.positions_mm[j], before.positions_mm[j]);
  std::vector<char> used(graph.stencils.size(), 0);
  for (const PointBinding& binding : model.bindings) {
    ASSERT_TRUE(binding.bound());
    used[binding.stencil] = 1;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);  // no stencil outlives its points
  EXPECT_GT(boundToTheNearest(model, model.size(), graph),
            0.99);  // cells decide what a new node is near to
}

// Of a strip as wide as one node, a node more than a reach away is among the four nearest.
TEST(GraphBuilder, KnowsAllNodesWhereANewOneReaches) {
  const PointModel whole = scenes::makeHill(80, 2, 0.4);
  PointModel model;
  WarpGraph graph = bindLeftHalf(whole, &model);
  const std::size_t old_points = model.size();
  const double before = boundToTheNearest(model, old_points, graph);
  addHalf(whole, true, Eigen::Isometry3d::Identity(), &model);
  EXPECT_GT(growGraph(GraphOptions(), &model, &graph).nodes_added, 5);
  EXPECT_GT(boundToTheNearest(model, old_points, graph), before);
}

TEST(GraphBuilder, NewNodesHaveMovedLikeTheTissueBesideThem) {
  const PointModel whole = scenes::makeHill(40, 20, 0.4);
  PointModel model;
  WarpGraph graph = bindLeftHalf(whole, &model);
  const std::size_t old_nodes = graph.size();
  const Eigen::Isometry3d motion = scenes::rigidMotion();
  scenes::moveNodes(motion, &graph);
  warpModel(graph, &model);
  rebase(&graph);
  addHalf(whole, true, motion, &model);
  growGraph(GraphOptions(), &model, &graph);
  ASSERT_GT(graph.size(), old_nodes);
  for (std::size_t j = old_nodes; j < graph.size(); ++j) {
    const Eigen::Vector3d& at = graph.positions_mm[j];
    const Eigen::Vector3d found = beforeMotion(graph.since_reference[j], at, at);
    EXPECT_LT((found - motion.inverse() * at).norm(), 1e-9);
  }
}

TEST(GraphBuilder, NewNodesFollowTheNearestOldOnes) {
  PointModel model = scenes::makeHill(30, 20, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const Eigen::Isometry3d motion = scenes::rigidMotion();
  scenes::moveNodes(motion, &graph);
  std::vector<NodeTransform> known = graph.transforms;
  known.resize(graph.size() / 2);

  followNeighbours(known, &graph);

  ASSERT_EQ(graph.transforms.size(), graph.size());
  for (std::size_t j = 0; j < graph.size(); ++j) {
    const Eigen::Vector3d& at = graph.positions_mm[j];
    EXPECT_LT((warpByNode(graph.transforms[j], at, at) - motion * at).norm(), 1e-9) << j;
    EXPECT_LT((graph.transforms[j].linear - motion.linear()).norm(), 1e-12) << j;
  }
  followNeighbours({}, &graph);  // none is known: they stay
  for (const NodeTransform& transform : graph.transforms)
    EXPECT_EQ(transform.translation_mm, Eigen::Vector3d::Zero());
}

TEST(GraphBuilder, DoesNothingWhereEveryPointIsBound) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const WarpGraph before = graph;
  const GraphGrowth growth = growGraph(GraphOptions(), &model, &graph);
  EXPECT_FALSE(growth.structure_changed);
  EXPECT_EQ(growth.nodes_added + growth.points_bound + growth.points_rebound, 0);
  EXPECT_EQ(graph.size(), before.size());
}

TEST(GraphBuilder, PointsBetweenOldOnesNeedNoNewStructure) {
  PointModel model = scenes::makeHill(20, 20, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const std::size_t nodes = graph.size();
  model.add(scenes::hillAt(0.1, 0.1).cast<float>(), {0, 0, -1}, {}, 1);
  const GraphGrowth growth = growGraph(GraphOptions(), &model, &graph);
  EXPECT_EQ(growth.points_bound, 1);
  EXPECT_EQ(growth.points_rebound, 0);
  EXPECT_EQ(graph.size(), nodes);
  EXPECT_TRUE(model.bindings.back().bound());
}

TEST(GraphBuilder, IsTheSameTwice) {
  PointModel first = scenes::makeHill(30, 30, 0.5), second = first;
  const WarpGraph a = scenes::bindGraph(&first), b = scenes::bindGraph(&second);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t j = 0; j < a.size(); ++j) EXPECT_EQ(a.positions_mm[j], b.positions_mm[j]);
  EXPECT_EQ(a.stencils, b.stencils);
}

TEST(GraphBuilder, IsTheSameOnAnyNumberOfThreads) {
  const auto grownTwice = [](int threads) {
    const ThreadLimit limit(threads);
    PointModel model = scenes::makeHill(70, 60, 0.4);
    WarpGraph graph = scenes::bindGraph(&model);
    for (std::size_t i = 0; i < model.size(); i += 3) model.bindings[i] = PointBinding();
    const PointModel wider = scenes::makeHill(80, 60, 0.4);
    for (std::size_t i = 0; i < wider.size(); ++i)
      if (std::abs(wider.positions_mm[i].x()) > 36)
        model.add(wider.positions_mm[i], wider.normals[i], wider.colours[i], 1);
    EXPECT_GT(growGraph(GraphOptions(), &model, &graph).nodes_added, 0);
    return std::make_pair(model, graph);
  };
  const auto [one_model, one_graph] = grownTwice(1);
  const auto [four_model, four_graph] = grownTwice(4);
  ASSERT_EQ(one_graph.size(), four_graph.size());
  for (std::size_t j = 0; j < one_graph.size(); ++j)
    EXPECT_EQ(one_graph.positions_mm[j], four_graph.positions_mm[j]);
  EXPECT_EQ(one_graph.stencils, four_graph.stencils);
  for (std::size_t i = 0; i < one_model.size(); ++i) {
    ASSERT_EQ(one_model.bindings[i].stencil, four_model.bindings[i].stencil) << i;
    ASSERT_EQ(one_model.bindings[i].weights, four_model.bindings[i].weights) << i;
  }
}

TEST(GraphBuilder, TakesTheEmptyTheSingleAndTheBroken) {
  PointModel model;
  WarpGraph graph = scenes::bindGraph(&model);
  EXPECT_TRUE(graph.empty());

  model.add({1, 2, 50}, {0, 0, -1}, {}, 1);
  growGraph(GraphOptions(), &model, &graph);
  ASSERT_EQ(graph.size(), 1u);
  EXPECT_EQ(graph.stencils[0], (NodeStencil{0, 0, 0, 0}));
  EXPECT_EQ(model.bindings[0].weights, (std::array<float, 4>{1, 0, 0, 0}));

  const float nan = std::numeric_limits<float>::quiet_NaN();
  model.add({nan, 2, 50}, {0, 0, -1}, {}, 1);
  model.add({1e30f, 2, 50}, {0, 0, -1}, {}, 1);
  growGraph(GraphOptions(), &model, &graph);
  EXPECT_EQ(graph.size(), 1u);
  EXPECT_FALSE(model.bindings[1].bound());
  EXPECT_FALSE(model.bindings[2].bound());
}

TEST(GraphBuilder, RefusesCellsThatAreTooLargeForTheSpacing) {
  PointModel model;
  WarpGraph graph;
  GraphOptions options;
  options.cell_mm = 3;
  EXPECT_THROW(growGraph(options, &model, &graph), OptionError);
}

}  // namespace
}  // namespace softscope
