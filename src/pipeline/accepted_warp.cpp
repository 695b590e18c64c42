#include "pipeline/accepted_warp.h"

#include <utility>

#include "deform/graph/warp.h"

namespace softscope {

void AcceptedWarp::apply(ModelUpdater* updater, ModelState* state) {
  before_ = Before{state->model.positions_mm, state->model.normals, state->graph, state->tracked};
  state->tracked.warp(state->graph, state->model);
  warpModel(state->graph, &state->model);
  updater->changed(kModelShape);
  rebase(&state->graph);
}

void AcceptedWarp::undo(ModelUpdater* updater, ModelState* state) {
  if (before_) {
    state->model.positions_mm = std::move(before_->positions_mm);
    state->model.normals = std::move(before_->normals);
    state->graph = std::move(before_->graph);
    state->tracked = std::move(before_->tracked);
    before_.reset();
    updater->changed(kModelShape);
  }
  for (NodeTransform& transform : state->graph.transforms) transform = NodeTransform();
}

}  // namespace softscope
