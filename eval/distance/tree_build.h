// eval/distance/tree_build.h: construction of the triangle tree.
#pragma once

#include <vector>

#include "core/triangle_mesh.h"
#include "eval/distance/tree_layout.h"

namespace softscope {

struct TreeMemory {
  std::vector<TreeNode> nodes;  // level by level from the leaves; the root is last
  std::vector<TreeLeaf> leaves;
  float slack_mm = 0;  // TreeView::slack_mm
};

/// Sorts the triangles by median splits of the centres of their boxes, eight
/// per leaf. Requires at least one triangle, valid indices and finite vertices.
TreeMemory buildTree(const TriangleMesh& mesh);

}  // namespace softscope
