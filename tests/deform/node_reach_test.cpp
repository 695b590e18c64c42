// tests/deform/node_reach_test.cpp: lists of close nodes, whenever a cell is listed.
#include "deform/graph/node_reach.h"

#include <gtest/gtest.h>

#include <random>

#include "deform/scenes.h"

namespace softscope {
namespace {

class NodeReachTest : public testing::Test {
 protected:
  NodeReachTest() {
    for (int node = 0; node < 40; ++node)
      starts_.push_back({node, hill_.positions_mm[random_() % hill_.size()]});
    for (int cell = 0; cell < cells_.size(); ++cell) all_cells_.push_back(cell);
  }

  void expectSameLists(const NodeReach& found, const NodeReach& expected,
                       const std::vector<int>& cells) {
    for (const int cell : cells) {
      ASSERT_EQ(found.near(cell).count, expected.near(cell).count) << cell;
      EXPECT_EQ(found.near(cell).nodes, expected.near(cell).nodes) << cell;
      EXPECT_EQ(found.near(cell).distance_mm, expected.near(cell).distance_mm) << cell;
    }
  }

  std::mt19937 random_{11};
  GraphOptions options_;
  PointModel hill_ = scenes::makeHill(24, 18, 0.25);
  SurfaceCells cells_{hill_.positions_mm, options_.cell_mm};
  std::vector<NodeReach::Start> starts_;
  std::vector<int> all_cells_;
};

TEST_F(NodeReachTest, ListsAreTheSameBeforeBetweenAndAfterTheWalks) {
  NodeReach before(cells_, options_), between(cells_, options_), after(cells_, options_);
  before.list(all_cells_);
  before.spreadAll(starts_);

  const std::vector<NodeReach::Start> first(starts_.begin(), starts_.begin() + 20),
      second(starts_.begin() + 20, starts_.end());
  between.spreadAll(first);
  for (const int cell : all_cells_) between.list({cell});
  between.spreadAll(second);

  after.spreadAll(starts_);
  after.list(all_cells_);
  after.list(all_cells_);  // again: no node twice

  int most = 0;
  for (const int cell : all_cells_) most = std::max(most, before.near(cell).count);
  EXPECT_EQ(most, NodeReach::kNearest);  // longer lists were cut
  expectSameLists(between, before, all_cells_);
  expectSameLists(after, before, all_cells_);
}

TEST_F(NodeReachTest, ANodeByItselfIsListedWhereItReaches) {
  NodeReach all(cells_, options_), reach(cells_, options_);
  all.list(all_cells_);
  all.spreadAll(starts_);
  reach.spreadAll({starts_.begin(), starts_.end() - 1});
  const std::vector<int> entered = reach.spread(starts_.back().node, starts_.back().position_mm);
  ASSERT_GT(entered.size(), 10u);
  expectSameLists(reach, all, entered);
}

}  // namespace
}  // namespace softscope
