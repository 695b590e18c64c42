// src/deform/cholesky/part_lists.h: stencils, edges and nodes that contribute to each block.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/cholesky/block_pattern.h"

namespace softscope {

constexpr int kEdgeBlocks = 3;  // jj, kj, kk

/// For each target, the numbers of its parts: targets + 1 starts.
struct GatherList {
  std::vector<int> start;
  std::vector<int> parts;
};

/// Numbering of parts: stencils (10 blocks, 4 gradients each),
/// edges (3, 2), and nodes (1, 1) with a term of their own.
struct PartLists {
  GatherList blocks, gradients;  // targets: blocks of the pattern; nodes
  int block_parts = 0, gradient_parts = 0;
};

PartLists makePartLists(const WarpGraph& graph, const BlockPattern& pattern, bool has_node_terms);

}  // namespace softscope
