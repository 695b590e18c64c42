// src/pipeline/model/active_region.h: the part of a large model that takes part in the frames.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "core/camera.h"
#include "core/warp_graph.h"
#include "fusion/density_grid.h"
#include "pipeline/model/model_state.h"

namespace softscope {

/// Surroundings of a view. Points beyond them may be inactive: they cost nothing, and when the view
/// comes near they are carried to where the motion of their nodes has taken them since. Only graphs
/// of more than LocalRule::kWholeUpTo nodes have inactive points. Same input, same bytes.
class ActiveRegion {
 public:
  ActiveRegion(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left,
               double node_spacing_mm)
      : left_(left),
        left_from_world_(world_from_left.inverse()),
        node_spacing_mm_(node_spacing_mm) {}

  /// Whether inactive points are in view, or nearly.
  bool reachesInactive(const ModelState& state) const;
  /// Appends the inactive points of the region to the model, and some behind its border.
  void activate(ModelState* state) const;

  /// Whether enough of the model lies beyond the region.
  bool leavesMuch(const ModelState& state) const;
  /// Takes the points beyond out of the model, but those around tracked points. Returns the new
  /// numbers of the others.
  IndexMap deactivate(ModelState* state) const;

 private:
  /// Per node, 1 within the image and that share of it on every side, or near enough to carry
  /// points there.
  std::vector<char> nodesWithin(double share, const WarpGraph& graph) const;
  std::vector<char> stencilsBeyond(const ModelState& state) const;

  PinholeCamera left_;
  Eigen::Isometry3d left_from_world_;
  double node_spacing_mm_;
};

void activateAll(ModelState* state);

std::size_t countInactive(const ModelState& state);

}  // namespace softscope
