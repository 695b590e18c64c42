#include "deform/cholesky/part_lists.h"

#include <numeric>
#include <utility>

#include "deform/kernels/deform_kernels.h"

namespace softscope {
namespace {

GatherList makeGatherList(int targets, const std::vector<std::pair<int, int>>& target_and_part) {
  GatherList list;
  list.start.assign(static_cast<std::size_t>(targets) + 1, 0);
  for (const auto& [target, part] : target_and_part) ++list.start[target + 1];
  std::partial_sum(list.start.begin(), list.start.end(), list.start.begin());
  list.parts.resize(target_and_part.size());
  std::vector<int> next = list.start;
  for (const auto& [target, part] : target_and_part) list.parts[next[target]++] = part;
  return list;
}

}  // namespace

PartLists makePartLists(const WarpGraph& graph, const BlockPattern& pattern, bool has_node_terms) {
  static_assert(kStencilBlocks == kNodesPerPoint * (kNodesPerPoint + 1) / 2);
  PartLists lists;
  std::vector<std::pair<int, int>> blocks, gradients;
  int &block_part = lists.block_parts, &gradient_part = lists.gradient_parts;
  for (const NodeStencil& stencil : graph.stencils) {
    const int nodes = distinctNodes(stencil);
    for (int i = 0; i < kNodesPerPoint; ++i) {
      for (int j = i; j < kNodesPerPoint; ++j, ++block_part)
        if (j < nodes) blocks.emplace_back(pattern.find(stencil[j], stencil[i]), block_part);
      if (i < nodes) gradients.emplace_back(stencil[i], gradient_part);
      ++gradient_part;
    }
  }
  for (const GraphEdge& edge : graph.edges) {
    blocks.emplace_back(pattern.find(edge.first, edge.first), block_part++);
    blocks.emplace_back(pattern.find(edge.second, edge.first), block_part++);
    blocks.emplace_back(pattern.find(edge.second, edge.second), block_part++);
    gradients.emplace_back(edge.first, gradient_part++);
    gradients.emplace_back(edge.second, gradient_part++);
  }
  if (has_node_terms)
    for (int node = 0; node < pattern.nodes(); ++node) {
      blocks.emplace_back(pattern.find(node, node), block_part++);
      gradients.emplace_back(node, gradient_part++);
    }
  lists.blocks = makeGatherList(pattern.blocks(), blocks);
  lists.gradients = makeGatherList(pattern.nodes(), gradients);
  return lists;
}

}  // namespace softscope
