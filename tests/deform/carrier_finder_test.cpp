// tests/deform/carrier_finder_test.cpp: carriers against their definition, in any order of points.
#include "deform/graph/carrier_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "deform/scenes.h"

namespace softscope {
namespace {

/// docs/energy.md (25) literally: all nodes of the cell sorted.
Carriers carriersByDefinition(const NodeReach::Near& near, const Eigen::Vector3f& point_mm,
                              const WarpGraph& graph, double spacing_mm) {
  std::vector<std::pair<double, int>> sorted;
  for (int i = 0; i < near.count; ++i)
    sorted.emplace_back((graph.positions_mm[near.nodes[i]] - point_mm.cast<double>()).norm(),
                        near.nodes[i]);
  std::sort(sorted.begin(), sorted.end());
  const double furthest = sorted.size() > kNodesPerPoint ? sorted[kNodesPerPoint].first
                                                         : sorted.back().first + spacing_mm;
  sorted.resize(std::min<std::size_t>(sorted.size(), kNodesPerPoint));
  double total = 0;
  for (auto& [share, node] : sorted) total += share = std::max(1 - share / furthest, 1e-6);
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  Carriers carriers;
  for (std::size_t i = 0; i < kNodesPerPoint; ++i) {
    carriers.stencil[i] = sorted[std::min(i, sorted.size() - 1)].second;
    carriers.weights[i] = i < sorted.size() ? static_cast<float>(sorted[i].first / total) : 0.0f;
  }
  return carriers;
}

/// A hill with nodes at some of its points, and points of it whose cell has a node.
class CarrierFinderTest : public testing::TestWithParam<int> {
 protected:
  CarrierFinderTest() {
    cells_ = std::make_unique<SurfaceCells>(hill_.positions_mm, options_.cell_mm);
    reach_ = std::make_unique<NodeReach>(*cells_, options_);
    for (int node = 0; node < GetParam(); ++node) {
      const Eigen::Vector3f& at = hill_.positions_mm[random_() % hill_.size()];
      graph_.positions_mm.push_back(at.cast<double>());
      reach_->spread(node, at);
    }
    for (std::size_t i = 0; i < hill_.size(); ++i)
      if (reach_->near(cellOf(i)).count > 0) points_.push_back(static_cast<int>(i));
  }

  int cellOf(std::size_t point) const { return cells_->cellAt(hill_.positions_mm[point]); }

  void expectDefinition() {
    CarrierFinder finder(*reach_, graph_, options_.node_spacing_mm);
    ASSERT_FALSE(points_.empty());
    for (const int i : points_) {
      const int cell = cellOf(i);
      const Eigen::Vector3f& point_mm = hill_.positions_mm[i];
      const Carriers found = finder.find(cell, point_mm);
      const Carriers expected =
          carriersByDefinition(reach_->near(cell), point_mm, graph_, options_.node_spacing_mm);
      ASSERT_EQ(found.stencil, expected.stencil) << i;
      ASSERT_EQ(found.weights, expected.weights) << i;  // the same bytes
    }
  }

  std::mt19937 random_{5};
  GraphOptions options_;
  PointModel hill_ = scenes::makeHill(24, 18, 0.25);
  std::vector<int> points_;
  std::unique_ptr<SurfaceCells> cells_;
  std::unique_ptr<NodeReach> reach_;
  WarpGraph graph_;
};

TEST_P(CarrierFinderTest, FindsWhatTheDefinitionSaysRowByRow) { expectDefinition(); }

TEST_P(CarrierFinderTest, FindsTheSameInAnyOrder) {
  std::shuffle(points_.begin(), points_.end(), random_);
  expectDefinition();
}

TEST_P(CarrierFinderTest, TakesTheLowerNumberOfEquallyCloseNodes) {
  const Eigen::Vector3d place = graph_.positions_mm[0] + Eigen::Vector3d(0.03, 0.02, 0.01);
  for (Eigen::Vector3d& position : graph_.positions_mm) position = place;
  expectDefinition();
}

INSTANTIATE_TEST_SUITE_P(Nodes, CarrierFinderTest, testing::Values(1, 3, 5, 40));

}  // namespace
}  // namespace softscope
