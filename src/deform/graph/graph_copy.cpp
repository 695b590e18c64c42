#include "deform/graph/graph_copy.h"

#include "core/parallel_copy.h"

namespace softscope {

static_assert(sizeof(WarpGraph) == 9 * sizeof(std::vector<int>), "copyGraph() copies all members");

void copyGraph(const WarpGraph& from, WarpGraph* to) {
  copyStructure(from, to);
  parallelCopy(from.transforms, &to->transforms);
  parallelCopy(from.since_reference, &to->since_reference);
  parallelCopy(from.turned, &to->turned);
  parallelCopy(from.edge_shapes, &to->edge_shapes);
  parallelCopy(from.inactive_pairs, &to->inactive_pairs);
}

void copyStructure(const WarpGraph& from, WarpGraph* to) {
  parallelCopy(from.positions_mm, &to->positions_mm);
  to->transforms.assign(from.size(), NodeTransform());
  parallelCopy(from.edges, &to->edges);
  parallelCopy(from.stencils, &to->stencils);
  to->afar = from.afar;
}

}  // namespace softscope
