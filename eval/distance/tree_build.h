// eval/distance/tree_build.h: from a mesh to the triangle tree's memory.
#pragma once

#include <vector>

#include "core/triangle_mesh.h"
#include "eval/distance/tree_layout.h"

namespace softscope {

struct TreeMemory {
  std::vector<TreeNode> nodes;  // level by level from the leaves up; the root is the last
  std::vector<TreeLeaf> leaves;
  float slack_mm = 0;  // TreeView::slack_mm
};

/// Sorts the triangles by median splits of their boxes' centres and packs them eight a leaf.
/// The mesh has at least one triangle, valid indices and finite vertices.
TreeMemory buildTree(const TriangleMesh& mesh);

}  // namespace softscope
