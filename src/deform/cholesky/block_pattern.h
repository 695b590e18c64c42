// src/deform/cholesky/block_pattern.h: block sparsity pattern of the normal equations.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/graph/node_pairs.h"

namespace softscope {

/// Lower triangle of a symmetric block matrix, one block column per
/// node; every diagonal block is present. Blocks are numbered by column.
struct BlockPattern {
  std::vector<int> column_start;  // nodes + 1 entries: the first block of each column
  std::vector<int> row;           // of each block, ascending within a column; the diagonal first

  int nodes() const { return static_cast<int>(column_start.size()) - 1; }
  int blocks() const { return static_cast<int>(row.size()); }
  /// Number of block (row i, column j), i >= j; -1 if absent.
  int find(int i, int j) const;
  bool operator==(const BlockPattern& other) const {
    return column_start == other.column_start && row == other.row;
  }
};

/// All pairs that share a stencil or an edge.
BlockPattern makeBlockPattern(const WarpGraph& graph);

/// From pairs (row, column), row > column, in any order, repeated or not.
BlockPattern makeBlockPattern(int nodes, NodePairs pairs);

}  // namespace softscope
