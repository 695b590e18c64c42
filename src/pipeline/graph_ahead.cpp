#include "pipeline/graph_ahead.h"

#include <utility>

#include "deform/graph/graph_builder.h"

namespace softscope {

void GraphAhead::prepare(const GraphOptions& options, const PointModel& model,
                         const WarpGraph& graph, DeformSolver* solver) {
  drop();
  result_ = std::async(std::launch::async, [this, options, &model, &graph, solver] {
    grown_.bindings = model.bindings;
    grown_.graph = graph;
    growGraph(options, model.positions_mm, &grown_.bindings, &grown_.graph);
    solver->prepare(grown_.graph);
  });
}

void GraphAhead::grow(const GraphOptions& options, PointModel* model, WarpGraph* graph) {
  if (!result_.valid()) {
    growGraph(options, model, graph);
    return;
  }
  result_.get();
  std::swap(model->bindings, grown_.bindings);
  std::swap(*graph, grown_.graph);
}

void GraphAhead::drop() {
  if (result_.valid()) result_.wait();
  result_ = {};
}

}  // namespace softscope
