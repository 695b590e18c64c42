#include "deform/cholesky/front_tables.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"
#include "deform/cholesky/dissection.h"

namespace softscope {
namespace {

class FrontPlanner {
 public:
  FrontPlanner(const BlockPattern& pattern, const EliminationTree& tree)
      : pattern_(pattern), tree_(tree), level_(tree.supernodes.size(), 0) {}

  FrontTables plan() {
    sortByLevel();
    for (const int s : by_level_) addFront(tree_.supernodes[s]);
    for (std::size_t f = 0; f < by_level_.size(); ++f) addChildren(static_cast<int>(f));
    return std::move(tables_);
  }

 private:
  void sortByLevel() {
    for (std::size_t s = 0; s < level_.size(); ++s)
      for (const int child : tree_.supernodes[s].children)
        level_[s] = std::max(level_[s], level_[child] + 1);
    by_level_.resize(level_.size());
    std::iota(by_level_.begin(), by_level_.end(), 0);
    std::stable_sort(by_level_.begin(), by_level_.end(),
                     [&](int a, int b) { return level_[a] < level_[b]; });
    front_of_.resize(level_.size());
    for (std::size_t f = 0; f < by_level_.size(); ++f) {
      const int s = by_level_[f];
      front_of_[s] = static_cast<int>(f);
      const auto border = static_cast<int>(tree_.supernodes[s].rows.size());
      if (level_[s] == static_cast<int>(tables_.level_start.size())) {
        tables_.level_start.push_back(static_cast<int>(f));
        tables_.level_tiles.push_back(0);
        tables_.level_rows.push_back(0);
      }
      const int pivots = tree_.supernodes[s].columns;
      tables_.level_tiles.back() = std::max(tables_.level_tiles.back(), updateTiles(border));
      tables_.level_rows.back() =
          std::max(tables_.level_rows.back(), pivots * ((pivots + border) * kRigidUnknowns + 1));
    }
    tables_.level_start.push_back(static_cast<int>(by_level_.size()));
  }

  void addFront(const Supernode& node) {
    FrontShape front;
    front.pivots = node.columns;
    front.blocks = node.columns + static_cast<int>(node.rows.size());
    front.first = node.first;
    front.nodes = static_cast<int>(tables_.nodes.size());
    for (int c = 0; c < node.columns; ++c) tables_.nodes.push_back(tree_.order[node.first + c]);
    for (const int position : node.rows) tables_.nodes.push_back(tree_.order[position]);
    // Even, so that pairs of numbers are aligned.
    front.factor_leading = front.blocks * kRigidUnknowns + 2;
    front.update_leading = (front.blocks - front.pivots) * kRigidUnknowns + 2;
    front.factor = static_cast<std::int64_t>(tables_.factor_doubles);
    front.update = static_cast<std::int64_t>(tables_.update_doubles);
    tables_.factor_doubles += static_cast<std::size_t>(front.factor_leading) *
                              static_cast<std::size_t>(front.pivots * kRigidUnknowns);
    tables_.update_doubles +=
        static_cast<std::size_t>(front.update_leading) *
        static_cast<std::size_t>((front.blocks - front.pivots) * kRigidUnknowns);
    front.look_up = static_cast<int>(tables_.look_up.size());
    const int* nodes = tables_.nodes.data() + front.nodes;
    for (int c = 0; c < front.pivots; ++c)
      for (int r = 0; r < front.blocks; ++r) tables_.look_up.push_back(entry(nodes[r], nodes[c]));
    tables_.fronts.push_back(front);
  }

  int entry(int row, int column) const {
    const int block = pattern_.find(std::max(row, column), std::min(row, column)) + 1;
    return row >= column ? block : -block;
  }

  void addChildren(int number) {
    FrontShape& front = tables_.fronts[number];
    front.child_begin = static_cast<int>(tables_.children.size());
    for (const int child : tree_.supernodes[by_level_[number]].children) {
      const FrontShape& from = tables_.fronts[front_of_[child]];
      tables_.children.push_back({front_of_[child], static_cast<int>(tables_.maps.size())});
      const int* border = tables_.nodes.data() + from.nodes + from.pivots;
      const int* border_end = tables_.nodes.data() + from.nodes + from.blocks;
      for (int b = 0; b < front.blocks; ++b) {
        const int* found = std::find(border, border_end, tables_.nodes[front.nodes + b]);
        tables_.maps.push_back(found == border_end ? -1 : static_cast<int>(found - border));
      }
    }
    front.child_end = static_cast<int>(tables_.children.size());
  }

  const BlockPattern& pattern_;
  const EliminationTree& tree_;
  std::vector<int> level_, by_level_, front_of_;
  FrontTables tables_;
};

}  // namespace

WarpStructure makeWarpStructure(const WarpGraph& graph) {
  const BlockPattern pattern = makeBlockPattern(graph);
  WarpStructure structure;
  // Independent.
  parallelInvoke(
      [&] {
        const EliminationTree tree = dissect(pattern, kMostPivots);
        structure.fronts = FrontPlanner(pattern, tree).plan();
      },
      [&] { structure.parts = makePartLists(graph, pattern, /*has_node_terms=*/false); });
  structure.nodes = static_cast<int>(graph.size());
  structure.stencils = graph.stencils;
  for (const GraphEdge& edge : graph.edges) {
    structure.edges.push_back(edge.first);
    structure.edges.push_back(edge.second);
  }
  structure.diagonal_of.assign(static_cast<std::size_t>(pattern.blocks()), -1);
  for (int j = 0; j < pattern.nodes(); ++j) structure.diagonal_of[pattern.column_start[j]] = j;
  return structure;
}

}  // namespace softscope
