#include "pipeline/graph_ahead.h"

#include <utility>

#include "deform/graph_builder.h"

namespace softscope {

void GraphAhead::prepare(const GraphOptions& options, const PointModel& model,
                         const WarpGraph& graph, DeformSolver* solver) {
  drop();
  result_ = std::async(std::launch::async, [options, &model, &graph, solver] {
    Grown grown{model.bindings, graph};
    growGraph(options, model.positions_mm, &grown.bindings, &grown.graph);
    solver->prepare(grown.graph);
    return grown;
  });
}

void GraphAhead::grow(const GraphOptions& options, PointModel* model, WarpGraph* graph) {
  if (!result_.valid()) {
    growGraph(options, model, graph);
    return;
  }
  Grown grown = result_.get();
  model->bindings = std::move(grown.bindings);
  *graph = std::move(grown.graph);
}

void GraphAhead::drop() {
  if (result_.valid()) result_.wait();
  result_ = {};
}

}  // namespace softscope
