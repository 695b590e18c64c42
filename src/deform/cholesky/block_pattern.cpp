#include "deform/cholesky/block_pattern.h"

#include <algorithm>

namespace softscope {

int BlockPattern::find(int i, int j) const {
  const auto begin = row.begin() + column_start[j], end = row.begin() + column_start[j + 1];
  const auto at = std::lower_bound(begin, end, i);
  return at != end && *at == i ? static_cast<int>(at - row.begin()) : -1;
}

BlockPattern makeBlockPattern(int nodes, NodePairs pairs) {
  for (auto& [row, column] : pairs) std::swap(row, column);  // sorted by column
  for (std::int32_t j = 0; j < nodes; ++j) pairs.emplace_back(j, j);
  sortNodePairs(nodes, &pairs);
  BlockPattern pattern;
  pattern.column_start.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const auto& [j, i] : pairs) {
    pattern.row.push_back(i);
    ++pattern.column_start[j + 1];
  }
  for (int j = 0; j < nodes; ++j) pattern.column_start[j + 1] += pattern.column_start[j];
  return pattern;
}

BlockPattern makeBlockPattern(const WarpGraph& graph) {
  NodePairs pairs;
  pairs.reserve(graph.stencils.size() * 6 + graph.edges.size());
  visitNodePairs(graph.stencils, [&](std::int32_t a, std::int32_t b) { pairs.emplace_back(b, a); });
  for (const GraphEdge& edge : graph.edges) pairs.emplace_back(edge.second, edge.first);
  return makeBlockPattern(static_cast<int>(graph.size()), std::move(pairs));
}

}  // namespace softscope
