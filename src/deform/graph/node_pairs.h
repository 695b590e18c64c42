// src/deform/graph/node_pairs.h: pairs of nodes, of stencils, sorted and unique.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/warp_graph.h"

namespace softscope {

using NodePairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Calls visit(a, b), a < b, for every pair of nodes in every stencil.
template <class Visit>
void visitNodePairs(const std::vector<NodeStencil>& stencils, const Visit& visit) {
  for (const NodeStencil& stencil : stencils)
    for (int b = 1; b < kNodesPerPoint; ++b)
      for (int a = 0; a < b; ++a)
        if (stencil[a] != stencil[b]) visit(stencil[a], stencil[b]);
}

/// Sorts by (first, second) and drops duplicates by two counting sorts,
/// with time linear in pairs plus nodes. Nodes are 0 to `nodes` - 1.
inline void sortNodePairs(int nodes, NodePairs* pairs) {
  NodePairs sorted(pairs->size());
  const auto sortBy = [&](std::int32_t NodePairs::value_type::*member) {
    std::vector<std::size_t> next(static_cast<std::size_t>(nodes) + 1, 0);
    for (const auto& pair : *pairs) ++next[static_cast<std::size_t>(pair.*member) + 1];
    for (std::size_t j = 1; j < next.size(); ++j) next[j] += next[j - 1];
    for (const auto& pair : *pairs) sorted[next[static_cast<std::size_t>(pair.*member)]++] = pair;
    pairs->swap(sorted);
  };
  sortBy(&NodePairs::value_type::second);
  sortBy(&NodePairs::value_type::first);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs->size(); ++i)
    if (i == 0 || (*pairs)[i] != (*pairs)[kept - 1]) (*pairs)[kept++] = (*pairs)[i];
  pairs->resize(kept);
}

}  // namespace softscope
