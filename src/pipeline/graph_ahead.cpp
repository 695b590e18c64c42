#include "pipeline/graph_ahead.h"

#include <utility>

#include "deform/graph/graph_builder.h"

namespace softscope {

void GraphAhead::prepare(const GraphOptions& options, const PointModel& model,
                         const WarpGraph& graph, DeformSolver* solver) {
  drop();
  std::promise<void> grown;
  growth_ = grown.get_future();
  thread_ = std::async(std::launch::async,
                       [this, options, &model, &graph, solver, grown = std::move(grown)]() mutable {
                         try {
                           grown_.bindings = model.bindings;
                           grown_.graph = graph;
                           growGraph(options, model.positions_mm, &grown_.bindings, &grown_.graph);
                           analysed_ = grown_.graph;
                         } catch (...) {
                           grown.set_exception(std::current_exception());
                           return;
                         }
                         grown.set_value();
                         solver->prepare(analysed_);
                       });
}

void GraphAhead::grow(const GraphOptions& options, PointModel* model, WarpGraph* graph) {
  if (!growth_.valid()) {
    growGraph(options, model, graph);
    return;
  }
  growth_.get();
  std::swap(model->bindings, grown_.bindings);
  std::swap(*graph, grown_.graph);
}

void GraphAhead::waitForSolver() {
  if (thread_.valid()) thread_.get();
}

void GraphAhead::drop() {
  if (thread_.valid()) thread_.wait();
  thread_ = {};
  growth_ = {};
}

}  // namespace softscope
