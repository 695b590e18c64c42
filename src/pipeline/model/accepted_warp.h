// src/pipeline/model/accepted_warp.h: warp of model, graph and tracked points that can be undone.
#pragma once

#include <memory>
#include <utility>

#include "deform/graph/model_warp.h"
#include "fusion/model_updater.h"
#include "pipeline/model/model_state.h"

namespace softscope {

/// At most one warp at a time: apply(), then keep() or undo().
class AcceptedWarp {
 public:
  explicit AcceptedWarp(std::unique_ptr<ModelWarp> of_model) : of_model_(std::move(of_model)) {}

  /// Warps by the graph's transforms and re-bases the graph. The model's points on the host may
  /// move with the next update only. Where a device fails, all is as it was.
  void apply(ModelUpdater* updater, double node_spacing_mm, ModelState* state);
  void keep() { is_applied_ = false; }
  /// All is as it was before apply(), without transforms. Without a warp, drops the transforms.
  void undo(ModelUpdater* updater, ModelState* state);

 private:
  struct Before {
    WarpGraph graph;
    MaterialPoints tracked;
  };
  std::unique_ptr<ModelWarp> of_model_;
  Before before_;  // of a warp that is applied; otherwise memory to reuse
  bool is_applied_ = false;
};

}  // namespace softscope
