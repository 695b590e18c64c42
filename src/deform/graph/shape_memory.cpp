#include "deform/graph/shape_memory.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr double kMemoryFrames = 100;  // time constant after permanent changes of the tissue

std::pair<std::int32_t, std::int32_t> nodesOf(const GraphEdge& edge) {
  return {edge.first, edge.second};
}

}  // namespace

void updateShapeMemory(WarpGraph* graph) {
  constexpr int kEdgesPerTask = 4096;
  parallelRanges(static_cast<int>(graph->edges.size()), kEdgesPerTask, [&](int begin, int end) {
    for (int e = begin; e < end; ++e) {
      GraphEdge& edge = graph->edges[static_cast<std::size_t>(e)];
      const Eigen::Vector3d offset =
          graph->positions_mm[edge.second] - graph->positions_mm[edge.first];
      edge.frames = std::min(edge.frames + 1, kMemoryFrames);
      edge.from_first_mm +=
          (graph->turned[edge.first].transpose() * offset - edge.from_first_mm) / edge.frames;
      edge.from_second_mm +=
          (graph->turned[edge.second].transpose() * -offset - edge.from_second_mm) / edge.frames;
    }
  });
}

void copyShapeMemory(const std::vector<GraphEdge>& from, std::vector<GraphEdge>* to) {
  auto known = from.begin();
  for (GraphEdge& edge : *to) {
    while (known != from.end() && nodesOf(*known) < nodesOf(edge)) ++known;
    if (known == from.end()) return;
    if (nodesOf(*known) != nodesOf(edge)) continue;
    edge.from_first_mm = known->from_first_mm;
    edge.from_second_mm = known->from_second_mm;
    edge.frames = known->frames;
  }
}

void expectShape(const WarpGraph& graph, double memory, std::vector<ExpectedOffsets>* expected) {
  expected->resize(graph.edges.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    const Eigen::Vector3d offset = graph.positions_mm[edge.second] - graph.positions_mm[edge.first];
    ExpectedOffsets& offsets = (*expected)[e];
    offsets = {offset, -offset};
    if (edge.frames == 0 || memory == 0) continue;
    offsets.from_first_mm +=
        memory * (graph.turned[edge.first] * edge.from_first_mm - offsets.from_first_mm);
    offsets.from_second_mm +=
        memory * (graph.turned[edge.second] * edge.from_second_mm - offsets.from_second_mm);
  }
}

}  // namespace softscope
