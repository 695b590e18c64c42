#include "pipeline/model/accepted_warp.h"

#include <utility>

#include "core/parallel.h"
#include "deform/graph/warp.h"

namespace softscope {

void AcceptedWarp::apply(ModelUpdater* updater, double node_spacing_mm, ModelState* state) {
  is_applied_ = true;
  before_.graph = state->graph;
  // Independent.
  parallelInvoke(
      [&] {
        before_.tracked = state->tracked;
        state->tracked.warp(state->graph, state->model, node_spacing_mm);
      },
      [&] {
        std::swap(before_.positions_mm, state->model.positions_mm);
        std::swap(before_.normals, state->model.normals);
        warpModel(state->graph, before_.positions_mm, before_.normals, &state->model);
      });
  updater->changed(kModelShape);
  rebase(&state->graph);
}

void AcceptedWarp::undo(ModelUpdater* updater, ModelState* state) {
  if (is_applied_) {
    std::swap(state->model.positions_mm, before_.positions_mm);
    std::swap(state->model.normals, before_.normals);
    std::swap(state->graph, before_.graph);
    std::swap(state->tracked, before_.tracked);
    is_applied_ = false;
    updater->changed(kModelShape);
  }
  for (NodeTransform& transform : state->graph.transforms) transform = NodeTransform();
}

}  // namespace softscope
