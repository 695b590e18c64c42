// eval/distance/tree_layout.h: memory layout of the triangle tree.
//
// An implicit tree of eight children a node: every level is packed to the left, so that node j of a
// level holds the nodes (or leaves) 8j to 8j + 7 of the level below. Boxes and triangles are
// structures of arrays, eight wide, for one SIMD test of all eight.
#pragma once

#include <cstdint>

namespace softscope {

constexpr int kTreeWidth = 8;  // children of a node, triangles of a leaf

/// The boxes of eight children; an absent child has an empty box (low = +inf, high = -inf).
struct alignas(32) TreeNode {
  float low[3][kTreeWidth];
  float high[3][kTreeWidth];
  std::int32_t first_child;  // in TreeView::leaves below leaf_count, else nodes + leaf_count
};

/// Eight triangles in frames of their own: corner A at the origin, B at (ab, 0), C at (cx, cy),
/// with AB the longest edge. Lanes without a triangle repeat the leaf's last one.
struct alignas(32) TreeLeaf {
  float origin[3][kTreeWidth];
  float axis_x[3][kTreeWidth];
  float axis_y[3][kTreeWidth];
  float axis_z[3][kTreeWidth];  // the triangle's normal, or any where it has none
  float ab[kTreeWidth];
  float cx[kTreeWidth];
  float cy[kTreeWidth];
  float inverse_ac2[kTreeWidth];  // 1 / |AC|², 0 where A = C
  float inverse_bc2[kTreeWidth];
  std::int32_t triangle[kTreeWidth];
};

/// Where on its triangle the closest point lies: face, edge i to i + 1, or corner i.
enum TreeFeature : std::int32_t { kTreeFace = 0, kTreeEdge = 1, kTreeVertex = 4 };

/// What the search found, in double. `triangle` is -1 where nothing was searched.
struct TreeHit {
  double distance2_mm2;
  double point_mm[3];
  double height_mm;  // above the triangle's plane; only where feature is kTreeFace
  std::int32_t triangle;
  std::int32_t feature;  // kTreeFace, kTreeEdge + i, kTreeVertex + i
};

/// The whole tree as the search sees it. The root is the last node.
struct TreeView {
  const TreeNode* nodes;
  const TreeLeaf* leaves;
  std::int32_t node_count;
  std::int32_t leaf_count;
  const float* vertices_mm;       // x y z
  const std::int32_t* triangles;  // three indices each
  float slack_mm;  // the float search errs by less, plus kTreeRelativeSlack of the distance
};

/// Each float distance of the search is within kTreeRelativeSlack * distance + slack_mm of the
/// true one: 2^-24 a rounding, fewer than 20 roundings; ten times that for safety.
constexpr float kTreeRelativeSlack = 1e-5f;
constexpr float kTreeEdgeSlack = 2e-6f;  // slack_mm over the longest edge

}  // namespace softscope
