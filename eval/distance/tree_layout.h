// eval/distance/tree_layout.h: memory layout of the triangle tree.
//
// An implicit tree of eight children a node: every level is packed to the left, so that node j of a
// level holds the nodes (or leaves) 8j to 8j + 7 of the level below. Boxes and triangles are
// structures of arrays, eight wide, for one SIMD test of all eight.
#pragma once

#include <cstdint>

namespace softscope {

constexpr int kTreeWidth = 8;  // children of a node, triangles of a leaf

/// Boxes of eight children; a missing child has an empty box (low = +inf, high = -inf).
struct alignas(32) TreeNode {
  float low[3][kTreeWidth];
  float high[3][kTreeWidth];
  std::int32_t first_child;  // in TreeView::leaves below leaf_count, else nodes + leaf_count
};

/// Eight triangles in local frames: corner A at the origin, B at (ab, 0), C at (cx,
/// cy), with AB the longest edge. Unused lanes repeat the last triangle of the leaf.
struct alignas(32) TreeLeaf {
  float origin[3][kTreeWidth];
  float axis_x[3][kTreeWidth];
  float axis_y[3][kTreeWidth];
  float axis_z[3][kTreeWidth];  // normal of the triangle; arbitrary for a degenerate triangle
  float ab[kTreeWidth];
  float cx[kTreeWidth];
  float cy[kTreeWidth];
  float inverse_ac2[kTreeWidth];  // 1 / |AC|², 0 where A = C
  float inverse_bc2[kTreeWidth];
  std::int32_t triangle[kTreeWidth];
};

/// Part of the triangle that contains the closest point: face, edge i to i + 1, or corner i.
enum TreeFeature : std::int32_t { kTreeFace = 0, kTreeEdge = 1, kTreeVertex = 4 };

/// Result of the search, in double. `triangle` is -1 without a search.
struct TreeHit {
  double distance2_mm2;
  double point_mm[3];
  double height_mm;  // above the plane of the triangle; kTreeFace only
  std::int32_t triangle;
  std::int32_t feature;  // kTreeFace, kTreeEdge + i, kTreeVertex + i
};

/// View of the whole tree for the search. The root is the last node.
struct TreeView {
  const TreeNode* nodes;
  const TreeLeaf* leaves;
  std::int32_t node_count;
  std::int32_t leaf_count;
  const float* vertices_mm;       // x y z
  const std::int32_t* triangles;  // three indices each
  float slack_mm;  // bound of the float error, plus kTreeRelativeSlack of the distance
};

/// Each float distance of the search is within kTreeRelativeSlack * distance + slack_mm of the
/// exact distance: 2^-24 per rounding, fewer than 20 roundings, with a safety factor of ten.
constexpr float kTreeRelativeSlack = 1e-5f;
constexpr float kTreeEdgeSlack = 2e-6f;  // slack_mm divided by the longest edge

}  // namespace softscope
