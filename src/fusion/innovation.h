// src/fusion/innovation.h: how far a frame lies from the model that was warped to meet it.
#pragma once

#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/visibility.h"

namespace softscope {

/// Mean squares around a place of the tissue, mm²: docs/fusion.md (F21), (F22).
struct Innovation {
  float difference_mm2 = 0;  // of measurement and warped model, along the ray
  float excess_mm2 = 0;  // of it, what the depth's own errors don't explain: the model's variance
};

/// What the seen points around each node say. Empty, and 0 everywhere, where nothing is known about
/// the depth's errors.
class InnovationField {
 public:
  InnovationField() = default;

  /// `graph` has live positions, `visibility` is about `model`.
  InnovationField(const PointModel& model, const WarpGraph& graph, const Observation& observation,
                  const Visibility& visibility, const PointFusionOptions& options);

  /// Of the nodes that carry a point, in the proportion in which they carry it.
  Innovation at(const WarpGraph& graph, const PointBinding& binding) const;

 private:
  std::vector<Innovation> nodes_;
};

}  // namespace softscope
