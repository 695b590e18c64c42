// src/pipeline/model/accepted_warp.h: warp of model, graph and tracked points that can be undone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fusion/model_updater.h"
#include "pipeline/model/model_state.h"

namespace softscope {

/// At most one warp at a time: apply(), then keep() or undo().
class AcceptedWarp {
 public:
  /// Warps by the graph's transforms and re-bases the graph.
  void apply(ModelUpdater* updater, double node_spacing_mm, ModelState* state);
  void keep() { is_applied_ = false; }
  /// All is as it was before apply(), without transforms. Without a warp, drops the transforms.
  void undo(ModelUpdater* updater, ModelState* state);

 private:
  struct Before {
    std::vector<Eigen::Vector3f> positions_mm, normals;
    WarpGraph graph;
    MaterialPoints tracked;
  };
  Before before_;  // of a warp that is applied; otherwise memory to reuse
  bool is_applied_ = false;
};

}  // namespace softscope
