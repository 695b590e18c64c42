// src/deform/cholesky/front_tables.h: graph, sums and fronts as flat arrays, in the layout that a
// device reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/warp_graph.h"
#include "deform/cholesky/block_pattern.h"
#include "deform/cholesky/part_lists.h"

namespace softscope {

constexpr int kRigidUnknowns = 6;

/// Maximum number of nodes per front: its pivots fit the memory of a multiprocessor.
constexpr int kMostPivots = 12;

/// Dense front of 6 x 6 blocks, column-major: columns of the factor
/// with the right-hand side as last row, and the update for the parent.
struct FrontShape {
  std::int64_t factor = 0, update = 0;  // offsets
  int pivots = 0, blocks = 0;           // nodes eliminated here; with those of the border
  int first = 0;                        // of the pivots' place in the order
  int nodes = 0;                        // offset into FrontTables::nodes: pivots, then border
  int look_up = 0;                      // offset into FrontTables::look_up
  int child_begin = 0, child_end = 0;   // in FrontTables::children
  int factor_leading = 0, update_leading = 0;
};

/// Update of a child, added by its parent.
struct FrontChild {
  int front = 0;
  int map = 0;  // offset into FrontTables::maps, one entry a block of the parent
};

/// Nested dissection of one graph. Fronts are sorted by level, those without children first.
struct FrontTables {
  std::vector<FrontShape> fronts;
  std::vector<int> level_start;  // levels + 1 entries
  // Of the level's fronts the most tiles of an update, and the most rows, one per node of the
  // pivots.
  std::vector<int> level_tiles, level_rows;
  std::vector<int> nodes;
  /// Per front, for each of its pivots a column of entries, one per block:
  /// 0 = absent, b + 1 = block b of the pattern, -(b + 1) = its transposed.
  std::vector<int> look_up;
  std::vector<FrontChild> children;
  std::vector<int> maps;  // the child's update block; -1 = none
  std::size_t factor_doubles = 0, update_doubles = 0;

  int levels() const { return static_cast<int>(level_start.size()) - 1; }
};

/// Rows and columns of a tile of an update.
constexpr int kUpdateTile = 48;

/// Tiles of the lower triangle of an update, including the row of the right-hand side.
constexpr int updateTiles(int border_blocks) {
  if (border_blocks == 0) return 0;
  const int columns = (border_blocks * kRigidUnknowns + kUpdateTile - 1) / kUpdateTile;
  const int rows = border_blocks * kRigidUnknowns / kUpdateTile + 1;
  return columns * (columns + 1) / 2 + (rows - columns) * columns;
}

/// Data that depend on the structure of the graph only.
struct WarpStructure {
  int nodes = 0;
  std::vector<NodeStencil> stencils;
  std::vector<std::int32_t> edges;        // first and second node of each
  std::vector<std::int32_t> diagonal_of;  // per block of the pattern: its node; -1 off the diagonal
  PartLists parts;
  FrontTables fronts;
};

WarpStructure makeWarpStructure(const WarpGraph& graph);

}  // namespace softscope
