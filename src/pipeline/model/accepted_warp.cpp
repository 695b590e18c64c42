#include "pipeline/model/accepted_warp.h"

#include <utility>

#include "core/parallel.h"
#include "deform/graph/graph_copy.h"
#include "deform/graph/warp.h"

namespace softscope {

void AcceptedWarp::apply(ModelUpdater* updater, double node_spacing_mm, ModelState* state) {
  bool is_on_host = false;
  parallelInvoke([&] { is_on_host = of_model_->apply(state->graph, &state->model); },
                 [&] {
                   copyGraph(state->graph, &before_.graph);
                   before_.tracked = state->tracked;
                 });
  if (is_on_host) updater->changed(kModelShape);
  is_applied_ = true;
  state->tracked.warp(state->graph, state->model, node_spacing_mm);
  rebase(&state->graph);
}

void AcceptedWarp::undo(ModelUpdater* updater, ModelState* state) {
  if (is_applied_) {
    of_model_->undo(&state->model);
    std::swap(state->graph, before_.graph);
    std::swap(state->tracked, before_.tracked);
    is_applied_ = false;
    updater->changed(kModelShape);
  }
  for (NodeTransform& transform : state->graph.transforms) transform = NodeTransform();
}

}  // namespace softscope
