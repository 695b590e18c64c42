// src/fusion/frame_comparer.h: comparison of the whole model with one frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "fusion/back_projection_error.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/point_fusion.h"
#include "fusion/view_evidence.h"

namespace softscope {

/// Comparison of a frame with the warped model, before fusion.
struct FrameComparison {
  BackProjectionError predicted;
  ViewEvidence view;
  ModelComparison model;
};

/// May work on another device. Implementations agree on sight, evidence, gain and anchors to the
/// byte, on sums up to rounding.
class FrameComparer {
 public:
  virtual ~FrameComparer() = default;

  // `states` are those of the observation's pixels.
  /// Indices of the points that the camera sees, ascending: findVisible().
  virtual std::vector<std::int32_t> visiblePoints(const PointModel& model,
                                                  const Observation& observation,
                                                  const Raster<PixelState>& states,
                                                  const VisibilityOptions& options) = 0;
  /// `graph` has live positions. The visibility may stay on the device, where the ModelUpdater of
  /// the same device finds it; it is empty then.
  virtual FrameComparison compare(const PointModel& model, const WarpGraph& graph,
                                  const Observation& observation, const Raster<PixelState>& states,
                                  const FusionOptions& options) = 0;
  /// Of the model as it is.
  virtual BackProjectionError error(const PointModel& model, const Observation& observation,
                                    const Raster<PixelState>& states) = 0;
};

class CpuFrameComparer final : public FrameComparer {
 public:
  std::vector<std::int32_t> visiblePoints(const PointModel& model, const Observation& observation,
                                          const Raster<PixelState>& states,
                                          const VisibilityOptions& options) override;
  FrameComparison compare(const PointModel& model, const WarpGraph& graph,
                          const Observation& observation, const Raster<PixelState>& states,
                          const FusionOptions& options) override;
  BackProjectionError error(const PointModel& model, const Observation& observation,
                            const Raster<PixelState>& states) override;
};

}  // namespace softscope
