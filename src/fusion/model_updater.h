// src/fusion/model_updater.h: stage 7 as an interface.
#pragma once

#include "fusion/model_parts.h"
#include "fusion/model_update.h"

namespace softscope {

/// updateModel(), which may work on another device. Every implementation gives the same bytes.
class ModelUpdater {
 public:
  virtual ~ModelUpdater() = default;
  /// These parts of the model, or the memory, are not as update() left them. What is not told so is
  /// taken to be as it was.
  virtual void changed(ModelParts /*parts*/) {}
  /// After this, the memory's raster is what update() left; before, it may be out of date.
  virtual void fetch(InsertionMemory* /*memory*/) {}
  virtual ModelUpdateSummary update(const Observation& observation,
                                    const Raster<PixelState>& states, const WarpGraph& graph,
                                    const FusionOptions& options, const ModelComparison& comparison,
                                    InsertionMemory* memory, PointModel* model) = 0;
};

class CpuModelUpdater final : public ModelUpdater {
 public:
  ModelUpdateSummary update(const Observation& observation, const Raster<PixelState>& states,
                            const WarpGraph& graph, const FusionOptions& options,
                            const ModelComparison& comparison, InsertionMemory* memory,
                            PointModel* model) override {
    return updateModel(observation, states, graph, options, comparison, memory, model);
  }
};

}  // namespace softscope
