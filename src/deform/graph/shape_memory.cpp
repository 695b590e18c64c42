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
  graph->edge_shapes.resize(graph->edges.size());
  parallelRanges(static_cast<int>(graph->edges.size()), kEdgesPerTask, [&](int begin, int end) {
    for (std::size_t e = static_cast<std::size_t>(begin); e < static_cast<std::size_t>(end); ++e) {
      const GraphEdge& edge = graph->edges[e];
      EdgeShape& shape = graph->edge_shapes[e];
      const Eigen::Vector3d offset =
          graph->positions_mm[edge.second] - graph->positions_mm[edge.first];
      shape.frames = std::min(shape.frames + 1, kMemoryFrames);
      shape.from_first_mm +=
          (graph->turned[edge.first].transpose() * offset - shape.from_first_mm) / shape.frames;
      shape.from_second_mm +=
          (graph->turned[edge.second].transpose() * -offset - shape.from_second_mm) / shape.frames;
    }
  });
}

std::vector<EdgeShape> edgeShapesOf(const std::vector<GraphEdge>& edges,
                                    const std::vector<GraphEdge>& known,
                                    const std::vector<EdgeShape>& known_shapes) {
  std::vector<EdgeShape> shapes(edges.size());
  const std::size_t count = std::min(known.size(), known_shapes.size());
  std::size_t k = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    while (k < count && nodesOf(known[k]) < nodesOf(edges[e])) ++k;
    if (k == count) break;
    if (nodesOf(known[k]) == nodesOf(edges[e])) shapes[e] = known_shapes[k];
  }
  return shapes;
}

void expectShape(const WarpGraph& graph, double memory, std::vector<ExpectedOffsets>* expected) {
  expected->resize(graph.edges.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    const Eigen::Vector3d offset = graph.positions_mm[edge.second] - graph.positions_mm[edge.first];
    ExpectedOffsets& offsets = (*expected)[e];
    offsets = {offset, -offset};
    if (memory == 0 || e >= graph.edge_shapes.size()) continue;
    const EdgeShape& shape = graph.edge_shapes[e];
    if (shape.frames == 0) continue;
    offsets.from_first_mm +=
        memory * (graph.turned[edge.first] * shape.from_first_mm - offsets.from_first_mm);
    offsets.from_second_mm +=
        memory * (graph.turned[edge.second] * shape.from_second_mm - offsets.from_second_mm);
  }
}

}  // namespace softscope
